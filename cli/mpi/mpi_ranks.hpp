// Ranks over MPI: the only file that uses MPI, in a separate library that is loaded when a run has ranks
// (cli/ranks/mpi_plugin.hpp).
//
// An MPI error is reported with the rank where it occurred and ends all ranks with exit code 4. A process that ends
// without destroying its MpiRanks, or by an exception, aborts all others instead of leaving them waiting.
#pragma once

#include <mpi.h>

#include <list>

#include "engine/ranks/ranks.hpp"

namespace pulvis {

class MpiRanks final : public Ranks {
 public:
  explicit MpiRanks(std::size_t most_bytes);
  ~MpiRanks() override;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  void maximum(std::span<double> numbers) override;
  void sum(std::span<std::int64_t> numbers) override;
  std::vector<Bytes> gather(std::span<const std::byte> own) override;
  void broadcast(Bytes& bytes) override;
  std::vector<Bytes> all_to_all(std::vector<Bytes> to) override;
  void send(Kind kind, std::vector<Message> messages) override;
  std::vector<Message> receive(Kind kind, std::span<const int> from) override;
  std::uint64_t bytes_sent() const override { return bytes_sent_; }
  double seconds_waited() const override { return seconds_waited_; }
  [[noreturn]] void abort(int exit_code) override;

 private:
  using Requests = std::vector<MPI_Request>;
  struct Sending {
    Bytes bytes;
    Requests parts;
  };

  void post_send(std::span<const std::byte> bytes, int to, int tag, Requests& requests) const;
  void post_receive(std::span<std::byte> bytes, int from, int tag, Requests& requests) const;
  Bytes receive_from(int rank, int tag) const;
  void forget_sent();
  int count_of(std::size_t numbers) const;

  std::size_t most_bytes_;
  MPI_Comm world_ = MPI_COMM_NULL;
  int rank_ = 0, count_ = 1;
  int exceptions_;  // in flight when it was constructed
  std::uint64_t bytes_sent_ = 0;
  double seconds_waited_ = 0;
  std::list<Sending> sending_;
};

}  // namespace pulvis

// The ranks of a run: processes that each hold a part of one world. All communication between them goes through here; it is
// implemented with MPI (cli/mpi), which no other code uses.
//
// All calls except those of an exchange are collective: every rank makes them, in the same order. No two threads may
// make calls at the same time. If a message cannot be delivered, all ranks are aborted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pulvis {

class Ranks {
 public:
  using Bytes = std::vector<std::byte>;
  struct Message {
    int rank;  // destination or source
    Bytes bytes;
  };
  // Messages of consecutive exchanges of the same kind are never confused.
  enum class Kind { outlines, contacts };

  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int count() const = 0;
  bool is_root() const { return rank() == 0; }

  // Elementwise over all ranks; every rank gets the result. A NaN on any rank gives +infinity.
  virtual void maximum(std::span<double> numbers) = 0;
  virtual void sum(std::span<std::int64_t> numbers) = 0;

  // Data of all ranks, in rank order on the root; empty elsewhere.
  virtual std::vector<Bytes> gather(std::span<const std::byte> own) = 0;
  // From the root to every rank.
  virtual void broadcast(Bytes& bytes) = 0;
  // [count] one to each rank; returns one from each.
  virtual std::vector<Bytes> all_to_all(std::vector<Bytes> to) = 0;

  // An exchange overlaps with computation: send() returns at once. Every message that is sent is received by the same
  // kind of exchange on the other rank.
  virtual void send(Kind kind, std::vector<Message> messages) = 0;
  // One message from each of `from`, in that order; waits for them.
  virtual std::vector<Message> receive(Kind kind, std::span<const int> from) = 0;

  // Bytes sent by this rank so far.
  virtual std::uint64_t bytes_sent() const = 0;
  // s, CPU time spent so far in calls that wait for other ranks: all except send().
  virtual double seconds_waited() const = 0;

  // Aborts all ranks at once, this one with `exit_code`.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

}  // namespace pulvis

// The ranks of a run: processes that each hold a part of one world. What they tell each other goes through here; behind it
// is MPI (cli/mpi), which nothing else knows of.
//
// All calls but those of an exchange are collective: every rank makes them, in the same order. None is made by two
// threads at once. What cannot be delivered ends all ranks.
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
    int rank;  // to it, or from it
    Bytes bytes;
  };
  // Of the messages between two exchanges of the same kind none is mistaken for another's.
  enum class Kind { outlines, contacts };

  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int count() const = 0;
  bool is_root() const { return rank() == 0; }

  // Number by number, over all ranks; every rank has the result. A NaN on any rank gives +infinity.
  virtual void maximum(std::span<double> numbers) = 0;
  virtual void sum(std::span<std::int64_t> numbers) = 0;

  // Of every rank, on the root in the order of the ranks; nothing elsewhere.
  virtual std::vector<Bytes> gather(std::span<const std::byte> own) = 0;
  // The root's, to every rank.
  virtual void broadcast(Bytes& bytes) = 0;
  // [count] one to each rank; returns one of each.
  virtual std::vector<Bytes> all_to_all(std::vector<Bytes> to) = 0;

  // An exchange goes on while its ranks compute: send() returns at once. Every message that is sent is received by the same
  // kind of exchange on the other rank.
  virtual void send(Kind kind, std::vector<Message> messages) = 0;
  // One message of each of `from`, in that order; waits for them.
  virtual std::vector<Message> receive(Kind kind, std::span<const int> from) = 0;

  // Bytes that this rank has sent so far.
  virtual std::uint64_t bytes_sent() const = 0;
  // s, processor time that calls which wait for other ranks have taken so far: all but send().
  virtual double seconds_waited() const = 0;

  // Ends all ranks at once, this one with `exit_code`.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

}  // namespace pulvis

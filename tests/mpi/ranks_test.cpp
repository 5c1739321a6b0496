// Every call of Ranks, made by several processes at once: mpirun -np N test_ranks [--joined | --leave HOW]. Without an
// option messages are cut into parts of some bytes, so that all ways of cutting them are gone.
//
// The calls are collective: a test goes on after a wrong figure, and every rank makes the same calls.
#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <numeric>
#include <thread>

#include "cli/mpi/mpi_ranks.hpp"
#include "cli/ranks/join_ranks.hpp"

namespace pulvis {
namespace {

using ::testing::ElementsAre;
using Kind = Ranks::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t part = 64;  // bytes

std::unique_ptr<Ranks> ranks;

// Bytes that say who sent them, to whom, and as which.
Ranks::Bytes written(int from, int to, int number, std::size_t size) {
  Ranks::Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] =
        static_cast<std::byte>(i * 7 + static_cast<std::size_t>(from * 31 + to * 17 + number * 5));
  return bytes;
}

// None, less than a part, a part, some parts, some parts and a byte, a thousand of them.
constexpr std::array<std::size_t, 8> sizes{0,        1,        part - 1,       part,
                                           part + 1, 3 * part, 200 * part + 1, 1 << 16};
std::size_t size_of(int from, int to, int number) {
  return sizes[static_cast<std::size_t>(from + 2 * to + number) % sizes.size()];
}

std::vector<int> all_ranks() {
  std::vector<int> all(static_cast<std::size_t>(ranks->count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(Ranks, MaximumOfEachNumber) {
  const double own = ranks->rank();
  std::vector<double> numbers{own, -own, -1e300 * (own + 1), 5e-324 * own, -infinity};
  ranks->maximum(numbers);
  const double last = ranks->count() - 1;
  EXPECT_THAT(numbers, ElementsAre(last, 0, -1e300, 5e-324 * last, -infinity));
}

TEST(Ranks, MaximumWithNanIsInfinite) {
  for (const int sick : all_ranks()) {
    std::vector<double> numbers{ranks->rank() == sick ? nan : 1.0,
                                ranks->rank() == sick ? -nan : 1e308, 2.0};
    ranks->maximum(numbers);
    EXPECT_THAT(numbers, ElementsAre(infinity, infinity, 2.0));
  }
}

// Whoever is compared with whom first, the sign of a zero is the same on every rank.
TEST(Ranks, MaximumOfZerosIsPositiveZero) {
  for (const int positive : all_ranks()) {
    std::vector<double> numbers{ranks->rank() == positive ? 0.0 : -0.0, -0.0};
    ranks->maximum(numbers);
    EXPECT_FALSE(std::signbit(numbers[0]));
    EXPECT_TRUE(std::signbit(numbers[1]));
  }
}

TEST(Ranks, SumOfEachNumber) {
  const std::int64_t own = ranks->rank(), count = ranks->count(), large = std::int64_t{1} << 60;
  std::vector<std::int64_t> numbers{own, -1, own == 0 ? large : 0};
  ranks->sum(numbers);
  EXPECT_THAT(numbers, ElementsAre(count * (count - 1) / 2, -count, large));
  ranks->sum(std::span<std::int64_t>());
}

TEST(Ranks, GatherInTheOrderOfRanks) {
  for (int number = 0; number < 8; ++number) {
    const int own = ranks->rank();
    const auto all = ranks->gather(written(own, 0, number, size_of(own, 0, number)));
    if (!ranks->is_root()) {
      EXPECT_TRUE(all.empty());
      continue;
    }
    ASSERT_EQ(all.size(), all_ranks().size());
    for (const int rank : all_ranks())
      EXPECT_EQ(all[static_cast<std::size_t>(rank)],
                written(rank, 0, number, size_of(rank, 0, number)));
  }
}

TEST(Ranks, BroadcastWhatTheRootHas) {
  for (const std::size_t size : sizes) {
    Ranks::Bytes bytes = written(ranks->rank(), 0, 0, ranks->is_root() ? size : 5);
    ranks->broadcast(bytes);
    EXPECT_EQ(bytes, written(0, 0, 0, size));
  }
}

TEST(Ranks, AllToAll) {
  for (int number = 0; number < 8; ++number) {
    const int own = ranks->rank();
    std::vector<Ranks::Bytes> to;
    for (const int rank : all_ranks())
      to.push_back(written(own, rank, number, size_of(own, rank, number)));
    const auto from = ranks->all_to_all(to);
    for (const int rank : all_ranks())
      EXPECT_EQ(from[static_cast<std::size_t>(rank)],
                written(rank, own, number, size_of(rank, own, number)));
  }
}

void send_to_all(Kind kind, int number) {
  std::vector<Ranks::Message> messages;
  const int own = ranks->rank();
  for (const int rank : all_ranks())
    messages.push_back({rank, written(own, rank, number, size_of(own, rank, number))});
  ranks->send(kind, std::move(messages));
}

void expect_from_all(Kind kind, int number, std::vector<int> from) {
  const auto messages = ranks->receive(kind, from);
  ASSERT_EQ(messages.size(), from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(messages[i].rank, from[i]);
    EXPECT_EQ(messages[i].bytes,
              written(from[i], ranks->rank(), number, size_of(from[i], ranks->rank(), number)));
  }
}

// Of both kinds, two exchanges deep, received in another order than they were sent; collective calls in between.
TEST(Ranks, ExchangesAreNotMistakenForEachOther) {
  std::vector<int> backwards = all_ranks();
  std::ranges::reverse(backwards);
  for (int round = 0; round < 20; ++round) {
    send_to_all(Kind::outlines, round);
    send_to_all(Kind::contacts, round + 1);
    send_to_all(Kind::outlines, round + 2);
    std::vector<std::int64_t> numbers{1};
    ranks->sum(numbers);
    EXPECT_EQ(numbers[0], ranks->count());
    expect_from_all(Kind::contacts, round + 1, backwards);
    expect_from_all(Kind::outlines, round, all_ranks());
    expect_from_all(Kind::outlines, round + 2, backwards);
  }
}

// Messages only between neighbours; a rank that is late holds up nobody who does not wait for it.
TEST(Ranks, NeighboursExchange) {
  const int own = ranks->rank(), count = ranks->count();
  std::vector<int> neighbours;
  for (const int rank : {own - 1, own + 1})
    if (rank >= 0 && rank < count) neighbours.push_back(rank);
  for (int step = 0; step < 200; ++step) {
    std::vector<Ranks::Message> messages;
    for (const int rank : neighbours)
      messages.push_back(
          {rank, written(own, rank, step, static_cast<std::size_t>(step * 13 % 4000))});
    ranks->send(Kind::contacts, std::move(messages));
    if (own == 0 && step % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (const Ranks::Message& message : ranks->receive(Kind::contacts, neighbours))
      EXPECT_EQ(message.bytes,
                written(message.rank, own, step, static_cast<std::size_t>(step * 13 % 4000)));
  }
}

TEST(Ranks, BytesSentAreCounted) {
  const std::uint64_t before = ranks->bytes_sent();
  const int own = ranks->rank(), next = (own + 1) % ranks->count(),
            previous = (own + ranks->count() - 1) % ranks->count();
  std::vector<Ranks::Message> messages;
  messages.push_back({next, Ranks::Bytes(1000)});
  ranks->send(Kind::outlines, std::move(messages));
  ranks->receive(Kind::outlines, std::vector<int>{previous});
  EXPECT_EQ(ranks->bytes_sent(), before + 1000);
}

// What other ranks are waited for in counts; what a rank computes does not, nor what it sends.
TEST(Ranks, WaitingIsCounted) {
  std::vector<std::int64_t> numbers{1};
  const double before = ranks->seconds_waited();
  ranks->sum(numbers);
  const double waited = ranks->seconds_waited();
  EXPECT_GT(waited, before);
  const int next = (ranks->rank() + 1) % ranks->count();
  const int last = (ranks->rank() + ranks->count() - 1) % ranks->count();
  std::vector<Ranks::Message> messages;
  messages.push_back({next, Ranks::Bytes(100000)});
  ranks->send(Ranks::Kind::outlines, std::move(messages));
  EXPECT_EQ(ranks->seconds_waited(), waited);
  ranks->receive(Ranks::Kind::outlines, std::vector<int>{last});
  EXPECT_GT(ranks->seconds_waited(), waited);
}

// By one thread after another.
TEST(Ranks, AnyThreadMayCall) {
  std::vector<std::int64_t> numbers{1};
  std::thread([&] { ranks->sum(numbers); }).join();
  EXPECT_EQ(numbers[0], ranks->count());
}

TEST(Ranks, TheSameProgramIsAccepted) {
  EXPECT_NO_THROW(require_alike(*ranks, "0.1 with AVX2", "one program"));
}

TEST(Ranks, AnotherProgramIsRefusedOnAllRanksAndToldOnce) {
  if (ranks->count() == 1) GTEST_SKIP() << "there is no other";
  const bool other = ranks->rank() == ranks->count() - 1;
  try {
    require_alike(*ranks, other ? "0.1 with AVX-512" : "0.1 with AVX2", "one program");
    ADD_FAILURE() << "was not refused";
  } catch (const UnlikeRanks& refusal) {
    if (ranks->is_root())
      EXPECT_THAT(refusal.what(), ::testing::AllOf(::testing::HasSubstr("0.1 with AVX2"),
                                                   ::testing::HasSubstr("0.1 with AVX-512")));
    else
      EXPECT_STREQ(refusal.what(), "");
  }
}

// Bound to processors or not: together the ranks have no more threads than processors, where there are enough.
TEST(Ranks, ThreadsShareTheProcessors) {
  const int processors = static_cast<int>(std::thread::hardware_concurrency()),
            own = machine_share_of(*ranks).threads;
  EXPECT_GE(own, 1);
  std::vector<std::int64_t> threads{own};
  ranks->sum(threads);
  EXPECT_LE(threads[0], std::max(processors, ranks->count()));
}

TEST(Ranks, TheRootKnowsTheMemoryOfEveryMachine) {
  const std::vector<MachineMemory> machines = machine_share_of(*ranks).machines;
  if (!ranks->is_root()) {
    EXPECT_TRUE(machines.empty());
    return;
  }
  ASSERT_EQ(machines.size(), 1U);  // this test has one machine
  EXPECT_EQ(machines[0].ranks, ranks->count());
  EXPECT_FALSE(machines[0].name.empty());
  EXPECT_GT(machines[0].left, 0U);
  EXPECT_LE(machines[0].left, left_by_machine() * 2);
}

// How a process may leave the others.
int leave(const std::string& how) {
  MpiRanks own(part);
  std::vector<std::int64_t> numbers{1};
  own.sum(numbers);
  const bool leaves = own.rank() == own.count() - 1;
  if (leaves && how == "abort") own.abort(4);
  if (leaves && how == "exit") std::exit(3);
  if (leaves && how == "killed") std::raise(SIGKILL);
  if (leaves && how == "throw") throw std::runtime_error("something went wrong");
  if (leaves && how == "wrong") {  // MPI refuses: there is no such rank
    std::vector<Ranks::Message> messages;
    messages.push_back({own.count(), Ranks::Bytes(1)});
    own.send(Kind::outlines, std::move(messages));
  }
  own.sum(numbers);  // waits for ever
  return 0;
}

}  // namespace

int run_all_tests() { return RUN_ALL_TESTS(); }

}  // namespace pulvis

int main(int argc, char** argv) {
  using namespace pulvis;
  ::testing::InitGoogleMock(&argc, argv);
  const std::string option = argc > 1 ? argv[1] : "";
  try {
    if (option == "--leave") return leave(argv[2]);
    if (option == "--joined")
      ranks = join_ranks();
    else
      ranks = std::make_unique<MpiRanks>(part);
    if (ranks == nullptr) {
      std::fprintf(stderr, "alone\n");
      return 5;
    }
    const int code = run_all_tests();
    ranks.reset();
    return code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  }
}

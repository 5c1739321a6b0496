#include "cli/mpi/mpi_ranks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string>

#include "cli/exit_code.hpp"
#include "cli/ranks/mpi_plugin.hpp"
#include "engine/processor_time.hpp"

namespace pulvis {
namespace {

constexpr int root = 0;
constexpr int collective =
    2;  // tag of gather and all_to_all messages; those of an exchange use its kind
static_assert(collective != static_cast<int>(Ranks::Kind::outlines) &&
              collective != static_cast<int>(Ranks::Kind::contacts));

constexpr int machine_failed = static_cast<int>(ExitCode::machine);

[[noreturn]] void end_all(int exit_code) {
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

[[noreturn]] void end_all(const char* what) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::fprintf(stderr, "pulvis: rank %d: %s\n", rank, what);
  end_all(machine_failed);
}

void end_at_error(MPI_Comm*, int* error, ...) {
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(*error, text.data(), &length);
  end_all(text.data());
}

// The process ends while the others still depend on it.
void end_unfinished(int exit_code, void*) {
  int finished = 0;
  MPI_Finalized(&finished);
  if (finished == 0) end_all(exit_code != 0 ? exit_code : machine_failed);
}

// Integers ordered like the doubles, -0 before 0: every rank gets the same bits, in whatever order ranks are compared.
std::int64_t in_order(double number) {
  if (std::isnan(number)) number = std::numeric_limits<double>::infinity();
  const auto bits = std::bit_cast<std::int64_t>(number);
  return bits < 0 ? bits ^ std::numeric_limits<std::int64_t>::max() : bits;
}
double from_order(std::int64_t bits) {
  return std::bit_cast<double>(bits < 0 ? bits ^ std::numeric_limits<std::int64_t>::max() : bits);
}

// Measures the processor time of a call that waits by polling.
class Waiting {
 public:
  explicit Waiting(double& seconds) : seconds_(seconds), since_(thread_seconds()) {}
  ~Waiting() { seconds_ += thread_seconds() - since_; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  double& seconds_;
  double since_;
};

}  // namespace

MpiRanks::MpiRanks(std::size_t most_bytes)
    : most_bytes_(most_bytes), exceptions_(std::uncaught_exceptions()) {
  int initialised = 0, provided = MPI_THREAD_SINGLE;
  MPI_Initialized(&initialised);
  if (initialised != 0) end_all("the ranks were joined before");
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  on_exit(end_unfinished, nullptr);
  MPI_Errhandler handler = MPI_ERRHANDLER_NULL;
  MPI_Comm_create_errhandler(end_at_error, &handler);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, handler);
  MPI_Errhandler_free(&handler);
  if (provided < MPI_THREAD_SERIALIZED)
    end_all(
        "this MPI cannot be called by several threads one after another (MPI_THREAD_SERIALIZED)");
  MPI_Comm_dup(MPI_COMM_WORLD, &world_);  // keeps its error handler
  MPI_Comm_rank(world_, &rank_);
  MPI_Comm_size(world_, &count_);
}

MpiRanks::~MpiRanks() {
  if (std::uncaught_exceptions() > exceptions_)
    return;  // its message is printed before the end: end_unfinished
  for (Sending& one : sending_)
    MPI_Waitall(static_cast<int>(one.parts.size()), one.parts.data(), MPI_STATUSES_IGNORE);
  MPI_Comm_free(&world_);
  MPI_Finalize();
}

int MpiRanks::count_of(std::size_t numbers) const {
  if (numbers > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    end_all("more numbers at once than MPI can count");
  return static_cast<int>(numbers);
}

void MpiRanks::maximum(std::span<double> numbers) {
  const Waiting waiting(seconds_waited_);
  std::vector<std::int64_t> keys(numbers.size());
  std::ranges::transform(numbers, keys.begin(), in_order);
  MPI_Allreduce(MPI_IN_PLACE, keys.data(), count_of(keys.size()), MPI_INT64_T, MPI_MAX, world_);
  std::ranges::transform(keys, numbers.begin(), from_order);
  bytes_sent_ += numbers.size_bytes();
}

void MpiRanks::sum(std::span<std::int64_t> numbers) {
  const Waiting waiting(seconds_waited_);
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), count_of(numbers.size()), MPI_INT64_T, MPI_SUM,
                world_);
  bytes_sent_ += numbers.size_bytes();
}

// In parts; the last one is shorter than the others, and may be empty: it marks the end of the message.
void MpiRanks::post_send(std::span<const std::byte> bytes, int to, int tag,
                         Requests& requests) const {
  for (bool more = true; more;) {
    more = bytes.size() >= most_bytes_;
    const auto part = bytes.first(std::min(bytes.size(), most_bytes_));
    MPI_Isend(part.data(), count_of(part.size()), MPI_BYTE, to, tag, world_,
              &requests.emplace_back());
    bytes = bytes.subspan(part.size());
  }
}

// Receives what post_send has sent, if its size is known.
void MpiRanks::post_receive(std::span<std::byte> bytes, int from, int tag,
                            Requests& requests) const {
  for (bool more = true; more;) {
    more = bytes.size() >= most_bytes_;
    const auto part = bytes.first(std::min(bytes.size(), most_bytes_));
    MPI_Irecv(part.data(), count_of(part.size()), MPI_BYTE, from, tag, world_,
              &requests.emplace_back());
    bytes = bytes.subspan(part.size());
  }
}

// If its size is not known.
Ranks::Bytes MpiRanks::receive_from(int rank, int tag) const {
  Bytes bytes;
  for (bool more = true; more;) {
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    int size = 0;
    MPI_Mprobe(rank, tag, world_, &message, &status);
    MPI_Get_count(&status, MPI_BYTE, &size);
    const std::size_t before = bytes.size();
    bytes.resize(before + static_cast<std::size_t>(size));
    MPI_Mrecv(bytes.data() + before, size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
    more = static_cast<std::size_t>(size) == most_bytes_;
  }
  return bytes;
}

std::vector<Ranks::Bytes> MpiRanks::gather(std::span<const std::byte> own) {
  const Waiting waiting(seconds_waited_);
  const auto size = static_cast<std::int64_t>(own.size());
  std::vector<std::int64_t> sizes(is_root() ? static_cast<std::size_t>(count_) : 0);
  MPI_Gather(&size, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, root, world_);
  Requests requests;
  std::vector<Bytes> all(sizes.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i) == rank_) {
      all[i].assign(own.begin(), own.end());
      continue;
    }
    all[i].resize(static_cast<std::size_t>(sizes[i]));
    post_receive(all[i], static_cast<int>(i), collective, requests);
  }
  if (!is_root()) {
    post_send(own, root, collective, requests);
    bytes_sent_ += own.size();
  }
  MPI_Waitall(count_of(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return all;
}

void MpiRanks::broadcast(Bytes& bytes) {
  const Waiting waiting(seconds_waited_);
  auto size = static_cast<std::int64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, root, world_);
  bytes.resize(static_cast<std::size_t>(size));
  for (std::span<std::byte> rest = bytes; !rest.empty();) {
    const auto part = rest.first(std::min(rest.size(), most_bytes_));
    MPI_Bcast(part.data(), count_of(part.size()), MPI_BYTE, root, world_);
    rest = rest.subspan(part.size());
  }
  if (is_root()) bytes_sent_ += bytes.size();
}

std::vector<Ranks::Bytes> MpiRanks::all_to_all(std::vector<Bytes> to) {
  const Waiting waiting(seconds_waited_);
  if (to.size() != static_cast<std::size_t>(count_))
    end_all("all_to_all: not one message for each rank");
  std::vector<std::int64_t> sizes(to.size()), theirs(to.size());
  std::ranges::transform(to, sizes.begin(), [](const Bytes& bytes) {
    return static_cast<std::int64_t>(bytes.size());
  });
  MPI_Alltoall(sizes.data(), 1, MPI_INT64_T, theirs.data(), 1, MPI_INT64_T, world_);
  Requests requests;
  std::vector<Bytes> all(to.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i) == rank_) continue;
    all[i].resize(static_cast<std::size_t>(theirs[i]));
    post_receive(all[i], static_cast<int>(i), collective, requests);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i) == rank_) continue;
    post_send(to[i], static_cast<int>(i), collective, requests);
    bytes_sent_ += to[i].size();
  }
  all[static_cast<std::size_t>(rank_)] = std::move(to[static_cast<std::size_t>(rank_)]);
  MPI_Waitall(count_of(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return all;
}

void MpiRanks::forget_sent() {
  std::erase_if(sending_, [](Sending& one) {
    int sent = 0;
    MPI_Testall(static_cast<int>(one.parts.size()), one.parts.data(), &sent, MPI_STATUSES_IGNORE);
    return sent != 0;
  });
}

void MpiRanks::send(Kind kind, std::vector<Message> messages) {
  forget_sent();
  for (Message& message : messages) {
    Sending& one = sending_.emplace_back(std::move(message.bytes), Requests());
    post_send(one.bytes, message.rank, static_cast<int>(kind), one.parts);
    bytes_sent_ += one.bytes.size();
  }
}

std::vector<Ranks::Message> MpiRanks::receive(Kind kind, std::span<const int> from) {
  const Waiting waiting(seconds_waited_);
  std::vector<Message> messages;
  for (const int rank : from)
    messages.push_back({rank, receive_from(rank, static_cast<int>(kind))});
  forget_sent();
  return messages;
}

void MpiRanks::abort(int exit_code) { end_all(exit_code); }

}  // namespace pulvis

extern "C" [[gnu::visibility("default")]] const pulvis::MpiPlugin* pulvis_mpi_plugin();
const pulvis::MpiPlugin* pulvis_mpi_plugin() {
  static const std::string build = pulvis::build_identity();
  static const pulvis::MpiPlugin plugin{
      build.c_str(),
      [](std::size_t most_bytes) -> pulvis::Ranks* { return new pulvis::MpiRanks(most_bytes); }};
  return &plugin;
}

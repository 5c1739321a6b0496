#include "systems/ranks/failure.hpp"

#include <cstring>
#include <limits>
#include <mutex>
#include <utility>

#include "engine/run_failure.hpp"

namespace pulvis {

void note_failure(RankLink& link, int position, const std::string& message) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (!link.failure.empty() && link.failed_at <= position) return;
  link.failure = message;
  link.failed_at = position;
}

void throw_failure_of_any(RankLink& link) {
  // What fails after agree() fails on all ranks alike: it depends only on what they agreed on.
  if (!link.any_failed) {
    if (link.failure.empty()) return;
    throw RunFailure(std::exchange(link.failure, {}));
  }
  constexpr double none = std::numeric_limits<double>::infinity();
  double first = link.failure.empty() ? -none : -static_cast<double>(link.failed_at);
  const double own = first;
  link.ranks->maximum({&first, 1});
  double rank = own == first ? -static_cast<double>(link.ranks->rank()) : -none;
  link.ranks->maximum({&rank, 1});
  Ranks::Bytes mine;
  if (static_cast<double>(link.ranks->rank()) == -rank) {
    const auto text = std::as_bytes(std::span(link.failure));
    mine.assign(text.begin(), text.end());
  }
  const std::vector<Ranks::Bytes> all = link.ranks->all_to_all(
      std::vector<Ranks::Bytes>(static_cast<std::size_t>(link.ranks->count()), mine));
  const Ranks::Bytes& told = all[static_cast<std::size_t>(-rank)];
  link.failure.clear();
  link.any_failed = false;
  throw RunFailure(std::string(reinterpret_cast<const char*>(told.data()), told.size()));
}

}  // namespace pulvis

#include "scenes/ranks/balance.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <utility>

#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "scenes/ranks/columns.hpp"
#include "scenes/ranks/divide.hpp"
#include "scenes/ranks/migrate.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t steps_between = 256;  // between checks, at least
constexpr std::int64_t most_wait = 64;       // times as many, if nothing was gained
constexpr double tolerance = 0.1;            // slowest rank over the mean, minus 1
constexpr double least_gain = 0.05;          // fraction of the slowest rank's cost
constexpr std::size_t least_steps = 32;      // for a meaningful median

// Cost of a row in units of a plastic element's time, and extra cost if it touches: from the systems' seconds in
// summary.json of regular-25, hexagonal-1683 and random-100-copper. Used only to split a rank's cost over its chunks.
struct RowCost {
  double row, touching;
};
constexpr RowCost plane_row{0.05, 7}, space_row{0.2, 15};

struct ChunkCost {
  std::array<double, 3> centre;  // m
  double weight;                 // in element times
};

template <class P>
std::array<double, 3> centre_of(const World& share, const Bodies& bodies, int chunk) {
  const Column<P>& position = share.column<P>();
  const auto first = position.table.chunk_begin[static_cast<std::size_t>(chunk)],
             end = position.table.chunk_begin[static_cast<std::size_t>(chunk) + 1];
  std::array<double, 3> sum{};
  double nodes = 0;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (entry(bodies.slots, chunk * lane_count + lane).number == Bodies::empty_slot) continue;
    nodes += end - first;
    for (int n = first; n < end; ++n)
      for (int k = 0; k < P::count; ++k)
        sum[static_cast<std::size_t>(k)] += position.lanes()[P::count * n + k][lane];
  }
  for (double& x : sum) x /= nodes;
  return sum;
}

// Cost of a chunk's rows, in element times.
template <class At>
double rows_cost(const World& share, const std::vector<std::int32_t>& begin, int chunk,
                 RowCost cost) {
  if (begin.empty() || !share.has<ContactTouches<At>>()) return 0;
  const std::uint8_t* touches = share.column<ContactTouches<At>>().values();
  const int first = entry(begin, chunk * lane_count), end = entry(begin, (chunk + 1) * lane_count);
  return cost.row * (end - first) +
         cost.touching * std::accumulate(touches + first, touches + end, 0.0);
}

double weight_of(World& share, int chunk) {
  const auto& begin = share.table<Element>().chunk_begin;
  const auto c = static_cast<std::size_t>(chunk);
  double weight = lane_count * static_cast<double>(begin[c + 1] - begin[c]);
  if (!share.has<ContactIndex>()) return weight;
  const ContactIndex& index = share.resource<ContactIndex>();
  weight += rows_cost<Contact>(share, index.sampled_begin, chunk, plane_row);
  weight += rows_cost<ToolContact>(share, index.tool_begin, chunk, plane_row);
  weight += rows_cost<FaceContact>(share, index.sampled_begin, chunk, space_row);
  weight += rows_cost<FaceToolContact>(share, index.tool_begin, chunk, space_row);
  return weight;
}

double median_of(std::vector<double> numbers) {
  if (numbers.empty()) return 0;
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::ranges::nth_element(numbers, middle);
  return *middle;
}

}  // namespace

double imbalance_of(const std::vector<double>& seconds) {
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  return sum > 0 ? std::ranges::max(seconds) * static_cast<double>(seconds.size()) / sum - 1 : 0;
}

Balance::Balance(World& share)
    : share_(share), ranks_(*share.resource<RankLink>().ranks), every_(steps_between) {}

void Balance::tell_costs() {
  if (own_.size() < least_steps) return;
  seconds_.assign(static_cast<std::size_t>(ranks_.count()), 0);
  entry(seconds_, ranks_.rank()) = median_of(own_);
  ranks_.maximum(seconds_);
  if (wants_after_) rebalancings_.back().after = seconds_;
}

bool Balance::divide() {
  const auto began = std::chrono::steady_clock::now();
  tell_costs();
  if (wants_after_) compare();
  own_.clear();
  RankLink& link = share_.resource<RankLink>();
  const Bodies& bodies = share_.resource<Bodies>();
  std::vector<ChunkCost> own;
  for (const int chunk : bodies.own_chunks)
    own.push_back({share_.has<Position<TwoD>>()
                       ? centre_of<Position<TwoD>>(share_, bodies, chunk)
                       : centre_of<Position<ThreeD>>(share_, bodies, chunk),
                   weight_of(share_, chunk)});
  const std::vector<Ranks::Bytes> told = ranks_.gather(bytes_of(own));
  std::vector<int> owner;
  if (ranks_.is_root()) owner = new_owners(told);
  const auto bytes = bytes_of(owner);
  Ranks::Bytes answer(bytes.begin(), bytes.end());
  ranks_.broadcast(answer);
  owner = list_in<int>(answer);
  if (owner.empty()) return false;
  Rebalancing made{share_.resource<Clock>().step, 0, 0, seconds_, {}};
  for (std::size_t chunk = 0; chunk < owner.size(); ++chunk)
    made.chunks += owner[chunk] != link.owner[chunk] ? 1 : 0;
  migrate(share_, owner);
  made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  rebalancings_.push_back(std::move(made));
  wants_after_ = true;
  return true;
}

// Empty if nothing changes.
std::vector<int> Balance::new_owners(const std::vector<Ranks::Bytes>& told) {
  if (!costs_ && imbalance_of(seconds_) <= tolerance) return {};
  const std::vector<int>& now = share_.resource<RankLink>().owner;
  std::vector<std::array<double, 3>> centre(now.size());
  std::vector<double> cost(now.size());
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    const auto chunks = list_in<ChunkCost>(told[rank]);
    double all = 0;
    for (const ChunkCost& chunk : chunks) all += chunk.weight;
    auto next = chunks.begin();
    for (std::size_t chunk = 0; chunk < now.size(); ++chunk) {
      if (now[chunk] != static_cast<int>(rank)) continue;
      centre[chunk] = next->centre;
      if (!costs_) cost[chunk] = seconds_[rank] * next->weight / all;
      ++next;
    }
  }
  if (costs_) cost = costs_(share_.resource<Clock>().step, static_cast<int>(now.size()));
  std::vector<int> owner = divide_chunks(centre, cost, ranks_.count());
  return owner != now && (costs_ || pays(cost, owner)) ? owner : std::vector<int>();
}

// Whether the slowest rank saves more until the next check than the last rebalancing cost, and more than noise.
bool Balance::pays(const std::vector<double>& cost, const std::vector<int>& owner) const {
  std::vector<double> then(seconds_.size());
  for (std::size_t chunk = 0; chunk < cost.size(); ++chunk)
    entry(then, owner[chunk]) += cost[chunk];
  const double slowest = std::ranges::max(seconds_), gain = slowest - std::ranges::max(then);
  const double price = rebalancings_.empty() ? 0 : rebalancings_.back().seconds;
  return gain > least_gain * slowest && gain * static_cast<double>(every_ * wait_) > price;
}

// Checks if the last rebalancing reduced the imbalance: if not, the next check is postponed.
void Balance::compare() {
  wants_after_ = false;
  if (costs_) return;
  const Rebalancing& last = rebalancings_.back();
  wait_ = imbalance_of(last.after) < imbalance_of(last.before) ? 1 : std::min(2 * wait_, most_wait);
}

}  // namespace pulvis

// list_border_rows, list_border_pairs: which rows two ranks share, and whose outlines they need.
//
// Law      a row belongs to the owner of its sampled particle, which computes it. The owner of the other particle has it
//          too, but inactive. Both list the shared rows in the same order: a row is identified by its position
// Runs     after the broad phase, when it has made new rows
// Active   when the run has several ranks
#include <algorithm>
#include <limits>
#include <map>

#include "systems/ranks/systems.hpp"

namespace pulvis {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// The rows shared by two ranks, by the number of the other rank.
class Shared {
 public:
  explicit Shared(const RankLink& link, const Bodies& bodies) : link_(link), bodies_(bodies) {}

  // `number`: of the row or pair. True if another rank computes it.
  bool take(int number, int sampled, int other) {
    const bool own = bodies_.owns(sampled), its = bodies_.owns(other);
    if (own && its) return false;
    const int far = own ? other : sampled;
    RankLink::Neighbour& rows = rows_[link_.owner_of(far)];
    RankLink::Neighbour& outlines = outlines_[link_.owner_of(far)];
    (own ? rows.send : rows.receive).push_back(number);
    if (own)
      outlines.receive.push_back(other);  // needed by this rank's narrow phase
    else
      outlines.send.push_back(other);  // needed by the other rank's
    return !own;
  }
  static std::vector<RankLink::Neighbour> listed(std::map<int, RankLink::Neighbour> by_rank,
                                                 bool slots) {
    std::vector<RankLink::Neighbour> all;
    for (auto& [rank, neighbour] : by_rank) {
      neighbour.rank = rank;
      for (std::vector<int>* list : {&neighbour.send, &neighbour.receive}) {
        if (!slots) continue;
        std::ranges::sort(*list);
        list->erase(std::unique(list->begin(), list->end()), list->end());
      }
      all.push_back(std::move(neighbour));
    }
    return all;
  }
  std::vector<RankLink::Neighbour> rows() const { return listed(rows_, false); }
  std::vector<RankLink::Neighbour> outlines() const { return listed(outlines_, true); }

 private:
  const RankLink& link_;
  const Bodies& bodies_;
  std::map<int, RankLink::Neighbour> rows_, outlines_;
};

}  // namespace

void list_border_rows::operator()() const {
  if (index->due) list();
}
// Nothing on this rank uses it: neither the narrow phase, nor bonds.
void list_border_rows::rest(Row<Contact> row) const {
  activation(row) = never;
  if (bonded) (*bonded)(row) = 0;
  if (weld_pressure)
    for (int i = 0; i < WeldPressure<Contact>::count; ++i) (*weld_pressure)(row, i) = 0;
}
void list_border_rows::list() const {
  Shared shared(*link, *bodies);
  for (int r = 0; r < pair.rows(); ++r) {
    const Row<Contact> row(r);
    if (shared.take(r, pair(row, 0), pair(row, 2))) rest(row);
  }
  link->rows = shared.rows();
  link->outlines = shared.outlines();
}

void list_border_pairs::operator()() const {
  if (index->due) list();
}
void list_border_pairs::rest(Row<FaceContact> row) const {
  for (int g = 0; g < space::face_points; ++g) {
    activation(row, g) = std::numeric_limits<float>::infinity();
    if (weld_pressure) (*weld_pressure)(row, g) = 0;
  }
  if (bonded)
    for (int i = 0; i < space::BondedPoints<FaceContact>::count; ++i) (*bonded)(row, i) = 0;
}
void list_border_pairs::list() const {
  Shared shared(*link, *bodies);
  for (int p = 0; p < pairs->count(); ++p) {
    const int first = entry(pairs->begin, p), end = entry(pairs->begin, p + 1);
    const Row<FaceContact> row(first);
    if (!shared.take(p, pair(row, 0), pair(row, 2))) continue;
    for (int r = first; r < end; ++r) rest(Row<FaceContact>(r));
  }
  link->rows = shared.rows();
  link->outlines = shared.outlines();
}

}  // namespace pulvis

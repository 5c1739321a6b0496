#include "scenes/packing/outlines/rigid_contact.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace pulvis {
namespace {

using portable::dot;
using portable::length;
using portable::Turn;
using portable::V2;

constexpr double none = std::numeric_limits<double>::lowest();
constexpr double hair = 1e-9;  // fraction of a diameter below which two gaps count as equal

struct Widest {
  double gap = none;
  std::size_t side = 0;    // of the piece
  std::size_t corner = 0;  // of the other piece, deepest behind that side
};

// The corner of a convex piece that lies deepest behind a side, searched from a given corner. The first of two.
std::size_t deepest_behind(V2 n, V2 from, const std::vector<V2>& corners, std::size_t begin) {
  const std::size_t count = corners.size();
  const auto gap = [&](std::size_t c) { return dot(n, corners[c] - from); };
  std::size_t at = begin, before = (at + count - 1) % count, after = (at + 1) % count;
  double here = gap(at), gap_before = gap(before), gap_after = gap(after);
  while (gap_after < here) {
    before = at, gap_before = here;
    at = after, here = gap_after;
    after = (at + 1) % count, gap_after = gap(after);
  }
  while (gap_before < here) {
    after = at, gap_after = here;
    at = before, here = gap_before;
    before = (at + count - 1) % count, gap_before = gap(before);
  }
  if (gap_before == here) at = std::min(at, before);
  if (gap_after == here) at = std::min(at, after);
  return at;
}

// The side of `piece` with the largest gap to the other one, the first of several. From side to side the deepest
// corner advances only a little. The other piece's centre gives an upper bound of the gap at each side: the side with the
// largest bound is evaluated first, and sides whose bound is below the gap found are skipped.
Widest widest_gap(const RigidPiece& piece, const RigidPiece& other, double enough) {
  const std::size_t sides = piece.normals.size();
  const auto promised = [&](std::size_t s) {
    return dot(piece.normals[s], other.centre - piece.corners[s]) - other.inside;
  };
  std::size_t first = 0;
  double most = none;
  for (std::size_t s = 0; s < sides; ++s)
    if (const double gap = promised(s); gap > most) first = s, most = gap;
  Widest best;
  std::size_t deepest = 0;
  const auto ask = [&](std::size_t s) {
    const V2 n = piece.normals[s], from = piece.corners[s];
    deepest = deepest_behind(n, from, other.corners, deepest);
    const double gap = dot(n, other.corners[deepest] - from);
    if (gap > best.gap || (gap == best.gap && s < best.side)) best = {gap, s, deepest};
  };
  if (sides > 0) ask(first);
  for (std::size_t s = 0; s < sides && best.gap <= enough; ++s)
    if (s != first && promised(s) + hair >= best.gap) ask(s);
  return best;
}

V2 nearest_on_side(const RigidPiece& piece, std::size_t side, V2 p) {
  const V2 a = piece.corners[side];
  if (piece.corners.size() == 1) return a;
  const V2 along = piece.corners[(side + 1) % piece.corners.size()] - a;
  const double share = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return a + share * along;
}

void put(const RigidPiece& from, Turn turn, V2 by, RigidPiece& to) {
  to.corners.resize(from.corners.size());
  to.normals.resize(from.normals.size());
  for (std::size_t i = 0; i < from.corners.size(); ++i) to.corners[i] = by + turn * from.corners[i];
  for (std::size_t i = 0; i < from.normals.size(); ++i) to.normals[i] = turn * from.normals[i];
  to.radius = from.radius;
  to.centre = by + turn * from.centre;
  to.reach = from.reach;
  to.inside = from.inside;
}

}  // namespace

const std::vector<RigidTouch>& RigidContacts::between(const RigidShape& a, const RigidPose& at_a,
                                                      const RigidShape& b, const RigidPose& at_b,
                                                      double range) {
  found_.clear();
  const V2 by = turned_back(at_a.turn, at_b.at - at_a.at);
  const Turn turn{at_a.turn.c * at_b.turn.c + at_a.turn.s * at_b.turn.s,
                  at_a.turn.c * at_b.turn.s - at_a.turn.s * at_b.turn.c};
  for (const RigidPiece& q : b.pieces) {
    const V2 centre = by + turn * q.centre;
    bool is_put = false;
    for (const RigidPiece& p : a.pieces) {
      const double reach = p.reach + q.reach + range;
      const V2 apart = centre - p.centre;
      if (!(dot(apart, apart) < reach * reach)) continue;
      if (!std::exchange(is_put, true)) put(q, turn, by, other_);
      pieces(p, other_, range);
    }
  }
  for (RigidTouch& touch : found_) {
    touch.point = at_a.at + at_a.turn * touch.point;
    touch.normal = at_a.turn * touch.normal;
  }
  return found_;
}

void RigidContacts::pieces(const RigidPiece& a, const RigidPiece& b, double range) {
  const double enough = range + a.radius + b.radius;
  const Widest of_a = widest_gap(a, b, enough);
  if (of_a.gap > enough) return;
  const Widest of_b = widest_gap(b, a, enough);
  if (of_b.gap > enough) return;
  const bool a_leads = of_a.gap >= of_b.gap - hair;
  const Widest& lead = a_leads ? of_a : of_b;
  const RigidPiece& leader = a_leads ? a : b;
  const RigidPiece& other = a_leads ? b : a;
  normals_sign_ = a_leads ? 1 : -1;
  const std::size_t before = found_.size();
  if (lead.gap > none) sides(leader, other, lead.side, lead.corner, range);
  const auto is_apart = [&](const RigidTouch& touch) {
    return touch.gap + leader.radius + other.radius > lead.gap + hair;
  };
  const bool beside =
      std::all_of(found_.begin() + static_cast<std::ptrdiff_t>(before), found_.end(), is_apart);
  if (!beside) return;  // the deepest corner lies in front of the side: that is the distance
  found_.resize(before);
  const V2 out = leader.normals.empty() ? V2{1, 0} : normals_sign_ * leader.normals[lead.side];
  // (For two stadiums end to end, no side shows that they are apart.)
  if (lead.gap > -hair || lead.gap == none) return nearest(a, b, out, range);
  add(other.corners[lead.corner], leader.normals[lead.side],
      lead.gap - leader.radius - other.radius);
}

// The part of the other piece's side that lies in front of the leader's, given by its ends.
void RigidContacts::sides(const RigidPiece& leader, const RigidPiece& other, std::size_t side,
                          std::size_t corner, double range) {
  const V2 n = leader.normals[side], from = leader.corners[side];
  const V2 t{-n.y, n.x};
  const double end = dot(leader.corners[(side + 1) % leader.corners.size()] - from, t);
  V2 p = other.corners[corner], q = p;
  if (other.corners.size() > 1) {
    const std::size_t last = (corner + other.corners.size() - 1) % other.corners.size();
    const bool goes_on = dot(other.normals[corner], n) < dot(other.normals[last], n);
    q = other.corners[goes_on ? (corner + 1) % other.corners.size() : last];
  }
  const double at_p = dot(p - from, t), at_q = dot(q - from, t);
  if (std::max(at_p, at_q) < 0 || std::min(at_p, at_q) > end) return;
  const auto add_at = [&](double share) {
    const V2 point = p + share * (q - p);
    const double gap = dot(n, point - from) - leader.radius - other.radius;
    if (gap < range) add(point, n, gap);
  };
  if (at_p == at_q) return add_at(0);
  const double first = (0 - at_p) / (at_q - at_p), second = (end - at_p) / (at_q - at_p);
  const double begin_share = std::clamp(std::min(first, second), 0.0, 1.0);
  const double end_share = std::clamp(std::max(first, second), 0.0, 1.0);
  add_at(begin_share);
  if (end_share > begin_share) add_at(end_share);
}

// `out`: the normal if the two have a point in common.
void RigidContacts::nearest(const RigidPiece& a, const RigidPiece& b, V2 out, double range) {
  double minimum = std::numeric_limits<double>::max();
  V2 on_a, on_b;
  // A corner this far from the circle around the other piece's corners cannot be the nearest.
  const auto too_far = [&](V2 corner, const RigidPiece& piece) {
    const double reach = piece.reach - piece.radius, apart = length(corner - piece.centre) - reach;
    return apart > 0 && apart * apart > minimum;
  };
  const auto compare = [&](V2 p, V2 q) {
    const V2 apart = q - p;
    if (dot(apart, apart) >= minimum) return;
    minimum = dot(apart, apart);
    on_a = p;
    on_b = q;
  };
  for (const V2 corner : a.corners)
    for (std::size_t s = 0; s < b.corners.size() && !too_far(corner, b); ++s)
      compare(corner, nearest_on_side(b, s, corner));
  for (const V2 corner : b.corners)
    for (std::size_t s = 0; s < a.corners.size() && !too_far(corner, a); ++s)
      compare(nearest_on_side(a, s, corner), corner);
  const double distance = std::sqrt(minimum), gap = distance - a.radius - b.radius;
  if (gap >= range) return;
  normals_sign_ = 1;
  add(on_b, distance > hair ? (1 / distance) * (on_b - on_a) : out, gap);
}

void RigidContacts::add(V2 point, V2 normal, double gap) {
  found_.push_back({point, normals_sign_ * normal, gap});
}

}  // namespace pulvis

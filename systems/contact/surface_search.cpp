#include "systems/contact/surface_search.hpp"
#include "engine/entry.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

using Piece = ToolSurface::Piece;

// 0 times infinity is NaN, but the end of a level piece has a finite height.
double along(double from, double t, double s) { return t == 0 ? from : from + t * s; }

Box straight_box(const Piece& p) {
  const double ends[] = {along(p.x, p.tx, p.low), along(p.y, p.ty, p.low), along(p.x, p.tx, p.high),
                         along(p.y, p.ty, p.high)};
  return box_of(ends, 2);
}

Box corner_box(const Piece& p) {
  return {{p.corner_x - p.radius, p.corner_y - p.radius},
          {p.corner_x + p.radius, p.corner_y + p.radius}};
}

Box piece_box(const Piece& p) {
  return p.side == 0 ? straight_box(p) : joined(straight_box(p), corner_box(p));
}

bool line_near(const Piece& p, const Box& box, double reach) {
  const double x = 0.5 * (box.low[0] + box.high[0]), y = 0.5 * (box.low[1] + box.high[1]);
  const double half = 0.5 * (std::abs(p.ty) * (box.high[0] - box.low[0]) +
                             std::abs(p.tx) * (box.high[1] - box.low[1]));
  return std::abs((y - p.y) * p.tx - (x - p.x) * p.ty) <= half + reach;
}

bool piece_near(const Piece& p, const Box& box, double reach) {
  if (near(straight_box(p), box, reach) && line_near(p, box, reach)) return true;
  return p.side != 0 && near(corner_box(p), box, reach);
}

// Pieces [first, last] are below tree[node].
struct Branch {
  std::size_t node;
  int first, last;
  bool leaf() const { return first == last; }
  int middle() const { return first + (last - first) / 2; }
  Branch left() const { return {2 * node + 1, first, middle()}; }
  Branch right() const { return {2 * node + 2, middle() + 1, last}; }
};

Box fill(ToolSurface& surface, const Branch& at) {
  const Box box = at.leaf() ? piece_box(entry(surface.pieces, at.first))
                            : joined(fill(surface, at.left()), fill(surface, at.right()));
  if (surface.tree.size() <= at.node) surface.tree.resize(at.node + 1);
  surface.tree[at.node] = {box.low[0], box.low[1], box.high[0], box.high[1]};
  return box;
}

constexpr int none = -1;

int extreme(const ToolSurface& surface, const Branch& at, const Box& box, double reach,
            bool from_the_end) {
  const ToolSurface::Box& b = surface.tree[at.node];
  if (!near({{b[0], b[1]}, {b[2], b[3]}}, box, reach)) return none;
  if (at.leaf()) {
    const bool found = piece_near(entry(surface.pieces, at.first), box, reach);
    return found ? at.first : none;
  }
  const Branch one = from_the_end ? at.right() : at.left();
  const Branch other = from_the_end ? at.left() : at.right();
  const int found = extreme(surface, one, box, reach, from_the_end);
  return found != none ? found : extreme(surface, other, box, reach, from_the_end);
}

Branch root(const ToolSurface& surface) {
  return {0, 0, static_cast<int>(surface.pieces.size()) - 1};
}

}  // namespace

void index_pieces(ToolSurface& surface) {
  surface.tree.clear();
  fill(surface, root(surface));
}

PieceRange pieces_near(const ToolSurface& surface, const Box& box, double reach) {
  const int first = extreme(surface, root(surface), box, reach, false);
  if (first == none) return {};
  return {first, extreme(surface, root(surface), box, reach, true)};
}

}  // namespace pulvis

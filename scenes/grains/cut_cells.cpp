// Random sites, Lloyd's relaxation (Lloyd 1982: every site moves to the centre of its cell), and the cells cut by the
// outline. Elongated grains are equiaxed grains of a plane that is stretched afterwards.
#include "scenes/grains/cut_cells.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

// The outline as a polygon in the plane of the cells.
class CutOutline {
 public:
  CutOutline(const OutlineCurve& curve, const Tessellation& wanted)
      : curve_(curve),
        turn_(rotation(-wanted.direction)),
        stretch_(std::sqrt(wanted.aspect_ratio)) {
    constexpr std::size_t stride = 4;  // of the curve's samples on smooth pieces
    const auto& samples = curve.samples();
    std::size_t in_piece = 0;
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      in_piece = samples[k].t == 0 ? 0 : in_piece + 1;
      if (curve.sharp() ? in_piece != 0 : in_piece % stride != 0) continue;
      places_.push_back(samples[k].s);
      points_.push_back(to_cells(curve.at(samples[k].s).at));
      if (curve.sharp()) corners_.push_back(samples[k].s);
    }
    for (const Vec2& p : points_) radius_ = std::max(radius_, p.norm());
  }

  double radius() const { return radius_; }
  const std::vector<double>& corners() const { return corners_; }
  double length() const { return curve_.length(); }
  Vec2 at(double s) const { return to_cells(curve_.at(s).at); }
  Vec2 to_cells(const Vec2& p) const {
    const Vec2 q = turn_ * p;
    return {q.x() / stretch_, q.y() * stretch_};
  }
  Vec2 from_cells(const Vec2& p) const {
    return turn_.transpose() * Vec2(p.x() * stretch_, p.y() / stretch_);
  }

  bool holds(const Vec2& p) const {
    bool inside = false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec2 &a = points_[i], &b = points_[(i + 1) % points_.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
  }

  struct Crossing {
    double t, s;  // fraction of the segment from p to q; m along the outline
  };
  std::vector<Crossing> crossings(const Vec2& p, const Vec2& q) const {
    std::vector<Crossing> found;
    const Vec2 d = q - p;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::size_t next = (i + 1) % points_.size();
      const double a = cross(d, points_[i] - p), b = cross(d, points_[next] - p);
      if ((a >= 0) == (b >= 0)) continue;
      const double share = a / (a - b);
      const Vec2 at = points_[i] + share * (points_[next] - points_[i]);
      const double t = (at - p).dot(d) / d.squaredNorm();
      if (t < 0 || t >= 1) continue;
      const double end = next == 0 ? curve_.length() : places_[next];
      found.push_back({t, places_[i] + share * (end - places_[i])});
    }
    std::ranges::sort(found, {}, &Crossing::t);
    return found;
  }

 private:
  const OutlineCurve& curve_;
  Eigen::Matrix2d turn_;
  double stretch_, radius_ = 0;
  std::vector<double> places_, corners_;
  std::vector<Vec2> points_;
};

class CutCells {
 public:
  CutCells(const CutOutline& outline, const std::vector<Vec2>& sites)
      : outline_(outline), cells_(voronoi_cells(sites, outline.radius())) {
    for (const Vec2& p : cells_.vertices) {
      inside_.push_back(outline.holds(p));
      map_.vertices.push_back({p});
    }
    for (const double s : outline.corners()) {
      corners_.push_back(static_cast<int>(map_.vertices.size()));
      map_.vertices.push_back({outline.at(s), s, true});
    }
    for (std::size_t cell = 0; cell < cells_.cells.size(); ++cell) cut(cell);
  }

  GrainMap map() && { return std::move(map_); }
  const std::vector<std::size_t>& cell_of_grain() const { return cell_of_grain_; }

 private:
  struct Piece {  // of a cell's side, inside the outline
    int from, to, neighbour;
    bool enters = false, leaves = false;  // the particle, at its start or end
  };

  // Vertices where the side between two cells crosses the outline, in the direction of the lower-numbered cell.
  const std::vector<int>& crossings_of(std::size_t cell, const VoronoiCells::Side& side, int end) {
    const int own = static_cast<int>(cell);
    const std::pair key(std::min(own, side.neighbour), std::max(own, side.neighbour));
    const auto [at, added] = crossings_.try_emplace(key);
    if (added) {
      const bool first = static_cast<int>(cell) < side.neighbour;
      const Vec2 p = vertex(first ? side.vertex : end), q = vertex(first ? end : side.vertex);
      for (const auto& crossing : outline_.crossings(p, q)) {
        at->second.push_back(static_cast<int>(map_.vertices.size()));
        map_.vertices.push_back({outline_.at(crossing.s), crossing.s});
      }
    }
    return at->second;
  }

  Vec2 vertex(int number) const { return cells_.vertices[static_cast<std::size_t>(number)]; }

  std::vector<Piece> pieces_of(std::size_t cell) {
    std::vector<Piece> pieces;
    const auto& sides = cells_.cells[cell];
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const int end = sides[(i + 1) % sides.size()].vertex;
      std::vector<int> crossed = crossings_of(cell, sides[i], end);
      if (static_cast<int>(cell) > sides[i].neighbour) std::ranges::reverse(crossed);
      bool inside = inside_[static_cast<std::size_t>(sides[i].vertex)];
      Piece piece{sides[i].vertex, 0, sides[i].neighbour};
      for (const int crossing : crossed) {
        if (inside) {
          piece.to = crossing;
          piece.leaves = true;
          pieces.push_back(piece);
        }
        inside = !inside;
        piece = {crossing, 0, sides[i].neighbour, inside};
      }
      if (!inside) continue;
      piece.to = end;
      pieces.push_back(piece);
    }
    return pieces;
  }

  double place(int number) const { return map_.vertices[static_cast<std::size_t>(number)].s; }

  // m, along the outline, counter-clockwise.
  double way(double from, double to) const {
    return to > from ? to - from : to + outline_.length() - from;
  }

  // The next piece after one that leaves the particle: where the outline enters the cell's boundary again.
  std::size_t next_entry(const std::vector<Piece>& pieces, const Piece& last) const {
    std::size_t best = pieces.size();
    double shortest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (!pieces[i].enters) continue;
      const double length = way(place(last.to), place(pieces[i].from));
      if (length >= shortest) continue;
      shortest = length;
      best = i;
    }
    return best;
  }

  void add_outline(int from, int to, std::vector<GrainMap::Side>& grain) const {
    grain.push_back({from, GrainMap::outside});
    std::vector<int> between;
    for (const int corner : corners_)
      if (way(place(from), place(corner)) < way(place(from), place(to))) between.push_back(corner);
    std::ranges::sort(between, {}, [&](int corner) { return way(place(from), place(corner)); });
    for (const int corner : between) grain.push_back({corner, GrainMap::outside});
  }

  // A chord and an arc: three sides are needed for a polygon.
  void split_outside(std::vector<GrainMap::Side>& grain) {
    const std::size_t side = grain[0].neighbour == GrainMap::outside ? 0 : 1;
    const double from = place(grain[side].vertex), to = place(grain[1 - side].vertex);
    const double middle = std::fmod(from + way(from, to) / 2, outline_.length());
    grain.insert(grain.begin() + static_cast<std::ptrdiff_t>(side) + 1,
                 {static_cast<int>(map_.vertices.size()), GrainMap::outside});
    map_.vertices.push_back({outline_.at(middle), middle});
  }

  void cut(std::size_t cell) {
    const std::vector<Piece> pieces = pieces_of(cell);
    std::vector<bool> used(pieces.size(), false);
    for (std::size_t start = 0; start < pieces.size(); ++start) {
      if (used[start]) continue;
      std::vector<GrainMap::Side> grain;
      std::size_t at = start;
      while (at < pieces.size() && !used[at]) {
        used[at] = true;
        const Piece& piece = pieces[at];
        grain.push_back({piece.from, piece.neighbour});
        at = piece.leaves ? next_entry(pieces, piece) : (at + 1) % pieces.size();
        if (piece.leaves && at < pieces.size()) add_outline(piece.to, pieces[at].from, grain);
      }
      if (grain.size() == 2) split_outside(grain);
      cell_of_grain_.push_back(cell);
      map_.grains.push_back(std::move(grain));
    }
  }

  const CutOutline& outline_;
  VoronoiCells cells_;
  GrainMap map_;
  std::vector<bool> inside_;
  std::vector<int> corners_;
  std::vector<std::size_t> cell_of_grain_;
  std::map<std::pair<int, int>, std::vector<int>> crossings_;
};

struct Lump {
  Vec2 centre;
  double area;
};

Lump lump_of(const GrainMap& map, const std::vector<GrainMap::Side>& grain) {
  const auto at = [&](std::size_t i) {
    return map.vertices[static_cast<std::size_t>(grain[i % grain.size()].vertex)].at;
  };
  Vec2 moment = Vec2::Zero();
  double area = 0;
  for (std::size_t i = 1; i + 1 < grain.size(); ++i) {
    const Vec2 a = at(i) - at(0), b = at(i + 1) - at(0);
    area += cross(a, b) / 2;
    moment += cross(a, b) / 6 * (a + b);
  }
  return {area > 0 ? Vec2(at(0) + moment / area) : at(0), area};
}

// For a cell in several parts the largest one counts.
void relax(const CutOutline& outline, std::vector<Vec2>& sites) {
  CutCells cut(outline, sites);
  const std::vector<std::size_t> cells = cut.cell_of_grain();
  const GrainMap map = std::move(cut).map();
  std::vector<double> largest(sites.size(), 0);
  for (std::size_t g = 0; g < map.grains.size(); ++g) {
    const Lump lump = lump_of(map, map.grains[g]);
    if (lump.area <= largest[cells[g]] || !outline.holds(lump.centre)) continue;
    largest[cells[g]] = lump.area;
    sites[cells[g]] = lump.centre;
  }
}

// Until here the sides refer to cells.
void name_grains(GrainMap& map, const std::vector<std::size_t>& cell_of_grain) {
  const auto has = [&](std::size_t grain, int from, int to) {
    const auto& sides = map.grains[grain];
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (sides[i].vertex == from && sides[(i + 1) % sides.size()].vertex == to) return true;
    return false;
  };
  std::multimap<std::size_t, std::size_t> grains_of;
  for (std::size_t g = 0; g < cell_of_grain.size(); ++g) grains_of.emplace(cell_of_grain[g], g);
  std::vector<std::vector<GrainMap::Side>> named = map.grains;
  for (std::size_t g = 0; g < map.grains.size(); ++g)
    for (std::size_t i = 0; i < map.grains[g].size(); ++i) {
      GrainMap::Side& side = named[g][i];
      if (side.neighbour == GrainMap::outside) continue;
      const int next = map.grains[g][(i + 1) % map.grains[g].size()].vertex;
      const auto [first, last] = grains_of.equal_range(static_cast<std::size_t>(side.neighbour));
      side.neighbour = GrainMap::outside;
      for (auto at = first; at != last; ++at)
        if (has(at->second, next, side.vertex))
          named[g][i].neighbour = static_cast<int>(at->second);
    }
  map.grains = std::move(named);
}

double random_share(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace

GrainMap tessellate(const OutlineCurve& curve, const Tessellation& wanted) {
  const CutOutline outline(curve, wanted);
  std::mt19937_64 random(wanted.seed);
  std::vector<Vec2> sites;
  while (static_cast<int>(sites.size()) < wanted.grains) {
    const double x = 2 * random_share(random) - 1, y = 2 * random_share(random) - 1;
    const Vec2 site = outline.radius() * Vec2(x, y);
    if (outline.holds(site)) sites.push_back(site);
  }
  for (int step = 0; step < wanted.relaxation; ++step) relax(outline, sites);
  CutCells cut(outline, sites);
  const std::vector<std::size_t> cells = cut.cell_of_grain();
  GrainMap map = std::move(cut).map();
  name_grains(map, cells);
  for (GrainMap::Vertex& vertex : map.vertices)
    vertex.at = vertex.on_outline() ? curve.at(vertex.s).at : outline.from_cells(vertex.at);
  return map;
}

}  // namespace pulvis

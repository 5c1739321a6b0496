#include "cli/report/report_profile.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cli/report/report_tags.hpp"
#include "cli/report/report_tetrahedra.hpp"

namespace pulvis {
namespace {

using Vec3 = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

constexpr double upright =
    1e-3;  // of a unit normal's component along z, and of that across its main axis

Box box_of(std::span<const double> xyz) {
  Box box;
  for (std::size_t i = 0; i < xyz.size(); i += 3) box.extend(Vec3(Vec3::Map(&xyz[i])));
  return box;
}

struct Piece {
  std::string kind;
  std::array<Vec3, 4> corners;
  Vec3 across() const { return (corners[2] - corners[0]).cross(corners[3] - corners[1]); }
  Vec3 normal() const { return across().normalized(); }
};

std::vector<Piece> pieces_of(const hdf5::File& file, const std::string& frame) {
  if (!file.contains("/tools/quads") || !file.contains(frame + "/tools/outline")) return {};
  const auto rows = file.read_integers("/tools/quads"),
             tool = file.read_integers("/tools/quad_tool");
  const auto kinds = lines_of(file.text_attribute("/tools/quad_tool", "kinds"));
  const auto xyz = file.read_doubles(frame + "/tools/outline");
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < tool.size(); ++i) {
    pieces.push_back({kinds.at(static_cast<std::size_t>(tool[i])), {}});
    for (std::size_t k = 0; k < 4; ++k)
      pieces.back().corners[k] = Vec3::Map(&xyz.at(3 * static_cast<std::size_t>(rows[4 * i + k])));
  }
  return pieces;
}

// Adds what lies in each slice; heights in slices.
void add(std::vector<double>& volume, const Tetrahedron& one) {
  const auto count = static_cast<double>(volume.size());
  if (one.z[3] <= 0 || one.z[0] >= count) return;
  const auto first = static_cast<std::size_t>(std::max(one.z[0], 0.0));
  double below = one.share_below(static_cast<double>(first));
  for (std::size_t slice = first; slice < volume.size() && below < 1; ++slice) {
    const double next = one.share_below(static_cast<double>(slice + 1));
    volume[slice] += one.volume * (next - below);
    below = next;
  }
}

// Whether the die, if there is one, is about z: its area is then turned equally far towards all directions normal to z.
bool die_stands(const std::vector<Piece>& pieces) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Piece& piece : pieces)
    if (piece.kind == "die") spread += piece.across() * piece.normal().transpose();
  const double all = spread.trace(), equal = spread.topLeftCorner<2, 2>().trace() / 2;
  spread.diagonal() -= Vec3(equal, equal, spread(2, 2));
  return spread.cwiseAbs().maxCoeff() <= upright * all;
}

// The nearest level plane on either side of the powder. In a die also the deepest point of a punch: up to there the cavity
// is the whole bore.
void find_ends(const std::vector<Piece>& pieces, CrossSection& section) {
  const bool die = std::ranges::any_of(pieces, [](const Piece& one) { return one.kind == "die"; });
  for (const Piece& piece : pieces) {
    const Vec3 normal = piece.normal();
    const bool level = normal.head<2>().cwiseAbs().maxCoeff() < upright;
    const bool faces = std::abs(normal.z()) > upright;
    if (!(piece.kind == "plane" && level) && !(die && piece.kind == "punch" && faces)) continue;
    for (const Vec3& corner : piece.corners)
      if (normal.z() > 0)
        section.bottom = std::max(section.bottom.value_or(corner.z()), corner.z());
      else
        section.top = std::min(section.top.value_or(corner.z()), corner.z());
  }
}

CrossSection room_across_z(const std::vector<Piece>& pieces, std::span<const double> xyz) {
  Box room = box_of(xyz), die,
      mouth;  // the die: its upright wall; the mouth: what widens or closes around its end
  bool walls = false;
  for (const Piece& piece : pieces) {
    const Vec3 normal = piece.normal(), &at = piece.corners[0];
    const bool stands = std::abs(normal.z()) < upright;
    if (piece.kind == "die")
      for (const Vec3& corner : piece.corners) (stands ? die : mouth).extend(corner);
    if (!stands) continue;
    for (const int k : {0, 1}) {
      if (piece.kind != "plane" || !(std::abs(normal[1 - k]) < upright)) continue;
      (normal[k] > 0 ? room.min() : room.max())[k] = at[k];
      walls = true;
    }
  }
  if (die.isEmpty())
    return {.area = room.sizes().x() * room.sizes().y(), .bound = walls ? "walls" : "powder"};
  CrossSection bore{.area = std::numbers::pi / 4 * die.sizes().x() * die.sizes().y(),
                    .bound = "die"};
  if (mouth.isEmpty()) return bore;  // longer than it is drawn
  bore.bound = "die with a mouth";
  const bool above = mouth.center().z() > die.center().z();
  (above ? bore.high : bore.low) = above ? die.max().z() : die.min().z();
  return bore;
}

}  // namespace

DensityProfile density_along_z(std::span<const double> xyz, std::span<const std::int32_t> hexahedra,
                               const CrossSection& section, std::size_t slices) {
  const Box box = box_of(xyz);
  const double low = std::max(section.bottom.value_or(box.min().z()), section.low);
  const double high = std::min(section.top.value_or(box.max().z()), section.high);
  const double step = (high - low) / static_cast<double>(slices);
  if (!(step > 0) || !(section.area > 0)) return {};
  DensityProfile profile{std::vector(slices, 0.0), {}};
  for (std::size_t i = 0; i <= slices; ++i)
    profile.edges.push_back(low + step * static_cast<double>(i));
  for (std::size_t first = 0; first < hexahedra.size(); first += 8)
    for_tetrahedra(xyz, hexahedra.subspan(first, 8), [&](Tetrahedron one) {
      for (double& z : one.z) z = (z - low) / step;
      add(profile.density, one);
    });
  for (double& density : profile.density) density /= section.area * step;
  return profile;
}

CrossSection cross_section(const hdf5::File& file, const std::string& frame,
                           std::span<const double> xyz) {
  const std::vector<Piece> pieces = pieces_of(file, frame);
  if (!die_stands(pieces)) return {.bound = "die across z"};
  CrossSection section = room_across_z(pieces, xyz);
  find_ends(pieces, section);
  return section;
}

}  // namespace pulvis

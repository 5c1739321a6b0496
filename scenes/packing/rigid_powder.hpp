// Rigid particles between the walls, floor and punch of a die, or in a periodic cell: separated, shaken and squeezed.
// Lengths in units of a mean diameter. Shapes, containers and contacts are those of outlines in two dimensions, of
// solids in three.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "components/dimension.hpp"
#include "scenes/packing/outlines/container.hpp"
#include "scenes/packing/solids/container.hpp"

namespace pulvis {

template <class D>
struct RigidTypes;

template <>
struct RigidTypes<TwoD> {
  using Vector = portable::V2;
  using Shape = RigidShape;
  using Pose = RigidPose;
  using Touch = RigidTouch;
  using Container = pulvis::Container;
  using Pair = NearPair;
  using Contacts = RigidContacts;
};

template <>
struct RigidTypes<ThreeD> {
  using Vector = space::V3;
  using Shape = space::RigidShape;
  using Pose = space::RigidPose;
  using Touch = space::RigidTouch;
  using Container = space::Container;
  using Pair = space::NearPair;
  using Contacts = std::optional<space::RigidTouch>;  // of convex solids: one at most
};

template <class D>
class RigidPowder {
 public:
  using Shape = typename RigidTypes<D>::Shape;
  using Pose = typename RigidTypes<D>::Pose;
  using Container = typename RigidTypes<D>::Container;

  // `margin`: particles are separated as if each were larger by this all around, so that any overlap left at the end is
  // still a gap. The shapes must outlive the powder.
  RigidPowder(const std::vector<Shape>& shapes, std::vector<int> shape_of,
              const Container& container, double margin);

  void scatter(double height, portable::Random& random);  // anywhere, overlaps allowed
  void squeeze(double height);  // scales the heights of all particles with it
  void shake(double displacement, portable::Random& random);  // every particle by at most this

  // Separates particles until no two overlap; false if that takes more than `max_sweeps`.
  bool relax(int max_sweeps);

  double height() const { return height_; }
  const std::vector<Pose>& poses() const { return poses_; }
  void restore(const std::vector<Pose>& poses, double height);
  std::int64_t sweeps() const { return sweeps_; }

  double min_gap();  // of all particles to each other and to the walls; negative if they overlap
  // Gaps of every particle to its three nearest neighbours, walls included, in its diameters; without a neighbour
  // within half a diameter, half a diameter is used. `touches`: pairs of particles whose gap is below `touching`
  // diameters of the smaller one.
  std::vector<std::array<double, 3>> near_gaps(double touching, int& touches);

 private:
  using Vector = typename RigidTypes<D>::Vector;
  using Touch = typename RigidTypes<D>::Touch;
  using Pair = typename RigidTypes<D>::Pair;

  const Shape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(shape_of_[i])];
  }
  Pose second_of(const Pair& pair) const;
  // Valid until the next call.
  std::span<const Touch> touches_of(Pair& pair, double range);
  // None if it is above `range`.
  std::optional<double> gap_of(Pair& pair, double range);
  std::optional<Touch> at_wall(std::size_t i, int wall, double range) const;
  void find_pairs(double range);
  bool lists_hold() const;
  void drift();
  double sweep();  // largest overlap found
  double push(Pair& pair);
  double push_from_walls(std::size_t i);
  double push_from_wall(std::size_t i, const Touch& touch, const Vector& centre);
  void correct(std::size_t i, const Vector& arm, const Vector& correction);

  const std::vector<Shape>& shapes_;
  std::vector<int> shape_of_;
  Container container_;
  double margin_;
  double height_ = 0;
  std::vector<Pose> poses_;
  std::vector<Pose> before_;  // from the last sweep
  std::vector<Pose> listed_;  // positions when the pairs were found
  std::vector<Pair> pairs_;
  typename RigidTypes<D>::Contacts contacts_;
  std::int64_t sweeps_ = 0;
};

}  // namespace pulvis

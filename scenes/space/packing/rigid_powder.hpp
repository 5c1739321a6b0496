// Rigid particles between walls, floor and punch of a die: separated, shaken, squeezed. Lengths in units of a
// mean diameter. The counterpart of scenes/packing/rigid_powder.hpp in three dimensions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/outlines/portable.hpp"
#include "scenes/space/packing/container.hpp"

namespace pulvis::space {

class RigidPowder {
 public:
  // `margin`: particles are separated as if each were larger by this all around, so that any overlap left at
  // the end is still a gap.
  RigidPowder(const std::vector<RigidShape>& shapes, std::vector<int> shape_of,
              const Container& container, double margin);

  void scatter(double height,
               portable::Random& random);  // anywhere, in any orientation, overlaps allowed
  void squeeze(double height);             // scales all particle positions with it
  void shake(double displacement, portable::Random& random);

  // Separates particles until no two overlap; false if that takes more than `max_sweeps`.
  bool relax(int max_sweeps);

  double height() const { return height_; }
  const std::vector<RigidPose>& poses() const { return poses_; }
  void restore(const std::vector<RigidPose>& poses, double height);
  std::int64_t sweeps() const { return sweeps_; }

  double min_gap();  // of all particles to each other and to the walls; negative if they overlap
  // Gaps of every particle to its three nearest neighbours, walls included, in its diameters; without a neighbour
  // within half a diameter, half a diameter is used. `touches`: pairs of particles whose gap is below `touching`
  // diameters of the smaller one.
  std::vector<std::array<double, 3>> near_gaps(double touching, int& touches);

 private:
  struct Pair {
    std::int32_t a, b;
    V3 normal;  // along which they were apart, or in contact, last
  };
  const RigidShape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(shape_of_[i])];
  }
  RigidPair pair_of(const Pair& pair) const;
  void find_pairs(double range);
  bool lists_hold() const;
  void drift();
  double sweep();  // largest overlap found
  double push(Pair& pair);
  double push_from_walls(std::size_t i);
  void correct(std::size_t i, const V3& arm, const V3& correction);

  const std::vector<RigidShape>& shapes_;
  std::vector<int> shape_of_;
  Container container_;
  double margin_;
  double height_ = 0;
  std::vector<RigidPose> poses_;
  std::vector<RigidPose> before_;  // from the last sweep
  std::vector<RigidPose> listed_;  // positions when the pairs were found
  std::vector<Pair> pairs_;
  std::int64_t sweeps_ = 0;
};

}  // namespace pulvis::space

// Rigid particles between walls, floor and punch of a die: pushed out of each other, shaken, squeezed. Lengths in units of a
// mean diameter. The same as scenes/packing/rigid_powder.hpp in three dimensions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/outlines/portable.hpp"
#include "scenes/space/packing/container.hpp"

namespace pulvis::space {

class RigidPowder {
 public:
  // `margin`: particles are pushed apart as if each were wider by this all around, so that what is left of their overlap at
  // the end is a gap.
  RigidPowder(const std::vector<RigidShape>& shapes, std::vector<int> shape_of,
              const Container& container, double margin);

  void scatter(double height,
               portable::Random& random);  // anywhere, turned anyhow, overlaps and all
  void squeeze(double height);             // every particle's place is scaled with it
  void shake(double displacement, portable::Random& random);

  // Pushes particles apart until no two overlap; false where that takes more than so many sweeps.
  bool relax(int max_sweeps);

  double height() const { return height_; }
  const std::vector<RigidPose>& poses() const { return poses_; }
  void restore(const std::vector<RigidPose>& poses, double height);
  std::int64_t sweeps() const { return sweeps_; }

  double min_gap();  // of all particles to each other and to the walls; negative where they overlap
  // Gaps of every particle to its three nearest neighbours, walls being neighbours, in its diameters; a particle without
  // one within half a diameter counts half a diameter. `touches`: pairs of particles whose gap is below `touching`
  // diameters of the smaller one.
  std::vector<std::array<double, 3>> near_gaps(double touching, int& touches);

 private:
  struct Pair {
    std::int32_t a, b;
    V3 normal;  // along which they were apart, or touched, last
  };
  const RigidShape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(shape_of_[i])];
  }
  RigidPair pair_of(const Pair& pair) const;
  void find_pairs(double range);
  bool lists_hold() const;
  void drift();
  double sweep();  // largest overlap it met
  double push(Pair& pair);
  double push_from_walls(std::size_t i);
  void correct(std::size_t i, const V3& arm, const V3& correction);

  const std::vector<RigidShape>& shapes_;
  std::vector<int> shape_of_;
  Container container_;
  double margin_;
  double height_ = 0;
  std::vector<RigidPose> poses_;
  std::vector<RigidPose> before_;  // the last sweep
  std::vector<RigidPose> listed_;  // where particles were when the pairs were found
  std::vector<Pair> pairs_;
  std::int64_t sweeps_ = 0;
};

}  // namespace pulvis::space

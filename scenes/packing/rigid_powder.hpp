// Rigid particles between the walls, floor and top punch of a die, or in a periodic cell: separated, shaken and
// squeezed. Lengths in units of a mean diameter; the left wall and the floor pass through the origin.
#pragma once

#include "scenes/packing/rigid_contact.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace pulvis {

class RigidPowder {
 public:
  // `margin`: particles are separated as if each were larger by this all around, so that any overlap left
  // at the end is still a gap.
  RigidPowder(std::vector<RigidShape> shapes, std::vector<int> shape_of, double width,
              double margin, bool periodic = false);

  void scatter(double height, portable::Random& random);  // anywhere, overlaps allowed
  void squeeze(double height);  // scales all particle positions with it
  void shake(double displacement, portable::Random& random);  // every particle by at most this

  // Separates particles until no two overlap; false if that takes more than `max_sweeps`.
  bool relax(int max_sweeps);

  double height() const { return height_; }
  double width() const { return width_; }
  const std::vector<RigidPose>& poses() const { return poses_; }
  void restore(const std::vector<RigidPose>& poses, double height);
  std::int64_t sweeps() const { return sweeps_; }

  double min_gap();  // of all particles to each other and to the tools; negative if they overlap
  // Gaps of every particle to its three nearest neighbours, tools included, in its diameters; without a neighbour
  // within half a diameter, half a diameter is used. `touches`: pairs of particles
  // whose gap is below `touching` diameters of the smaller one.
  std::vector<std::array<double, 3>> near_gaps(double touching, int& touches);

 private:
  struct Pair {
    std::int32_t a, b;
    std::int32_t x = 0, y = 0;  // periods by which b is shifted
  };
  struct Home {  // periods that move a particle into the cell
    std::int32_t x = 0, y = 0;
  };
  RigidPose image(const Pair& pair) const {
    RigidPose pose = poses_[static_cast<std::size_t>(pair.b)];
    pose.at = pose.at + portable::V2{pair.x * width_, pair.y * height_};
    return pose;
  }
  void find_pairs_in_cell(double range);
  const RigidShape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(shape_of_[i])];
  }
  void find_pairs(double range);
  bool lists_hold() const;
  void drift();
  double sweep();  // largest overlap found
  double push(const Pair& pair);
  double push_from_tools(std::size_t i);
  void correct(std::size_t i, portable::V2 arm, portable::V2 correction);
  void touches_with_tools(std::size_t i, double range, std::vector<RigidTouch>& touches) const;

  std::vector<RigidShape> shapes_;
  std::vector<int> shape_of_;
  double width_, margin_;
  bool periodic_;
  double height_ = 0;
  double largest_reach_ = 0;
  std::vector<RigidPose> poses_;
  std::vector<RigidPose> before_;  // from the last sweep
  std::vector<RigidPose> listed_;  // positions when the pairs were found
  std::vector<Pair> pairs_;
  RigidContacts contacts_;
  std::vector<RigidTouch> tool_touches_;
  std::int64_t sweeps_ = 0;
};

}  // namespace pulvis

// Columns of contact in three dimensions: the smooth surfaces, and the candidate pairs that may touch. A candidate is one
// face of a particle (the sampled side, 4 x 4 Gauss points) paired with one other particle or tool. Both particles of a pair
// sample each other: the contact is unbiased.
//
// Pairs, laws, friction history and block sums are shared with two dimensions (components/contact.hpp), as are the
// settings and the index of rows (components/run_state.hpp). Bodies::Slot::first_control is a particle's first Bezier point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/shaped_bodies.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"

namespace pulvis::space {

inline constexpr int face_points = FaceContact::points;  // two lanes
inline constexpr int patch_points = 16;
inline constexpr int face_numbers = 3 * patch_points;  // x of a face's Bezier points, then y, z

// ---- surfaces -----------------------------------------------------------------------------------
// Faces share the points on their sides: Shape::Face::point gives their numbers.
struct SurfacePosition : Component<ParticleSurface, double, 3> {
  static constexpr ComponentInfo info{"position", "m", "of a Bezier point"};
};
struct SurfaceVelocity : Component<ParticleSurface, double, 3> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of a Bezier point"};
};
struct SurfaceBefore : Component<ParticleSurface, double, 3> {
  static constexpr ComponentInfo info{"before", "m", "where it was when the candidates were made"};
};
// Every point of a particle's surface moves with this velocity, give or take the difference.
struct SurfaceMotion : Component<WholeSurface, double, 4> {
  static constexpr ComponentInfo info{"motion", "m/s",
                                      "mean velocity x y z, largest difference of any point"};
  enum Number { mean, difference = 3 };
};
// Whether any surface node of a particle is farther from the smooth surface than its slack.
struct Roughness : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"roughness", "m^2",
                                      "largest square of that distance minus that of the slack"};
};
struct NodeDistance : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{
      "node_distance", "-",
      "largest distance of a surface node from the smooth surface, relative to the size of a face"};
};
struct FaceForce : Component<SurfaceFace, double, face_numbers> {
  static constexpr ComponentInfo info{"force", "N",
                                      "of all contacts, on a face's Bezier points: all x, y, z"};
  static constexpr bool scratch = true;
};
// Between the nodes and these points, in both directions, eight particles at a time: the net (a point per node), and the points.
struct NetPosition : Component<BoundaryNode, double, 3> {
  static constexpr ComponentInfo info{"net_position", "m", "of a point of the control net"};
  static constexpr bool scratch = true;
};
struct NetVelocity : Component<BoundaryNode, double, 3> {
  static constexpr ComponentInfo info{"net_velocity", "m/s", "of a point of the control net"};
  static constexpr bool scratch = true;
};
struct NetLoad : Component<BoundaryNode, double, 3> {
  static constexpr ComponentInfo info{"net_load", "N",
                                      "of all contacts, on a point of the control net"};
  static constexpr bool scratch = true;
};
struct PointLoad : Component<SurfacePoint, double, 3> {
  static constexpr ComponentInfo info{"load", "N", "of all contacts, on a Bezier point"};
  static constexpr bool scratch = true;
};

// ---- candidates -----------------------------------------------------------------------------------
// At: FaceContact or FaceToolContact.
// Points become inactive one by one against another particle, where usually few touch; half a row at a time against a
// tool. Point values are floats, rounded down: those of a row fit in one cache line.
template <class At, bool Points = std::is_same_v<At, FaceContact>>
struct ReactivationDistance
    : Component<At, std::conditional_t<Points, float, double>, Points ? face_points : 2> {
  static constexpr ComponentInfo info{
      "activation", "m",
      "travel of the surfaces from which on what rests is active again; 0 of a point that touches"};
};
// Clock::relative_motion, by which rows of two dimensions and those with tools rest, is the same for any two surfaces: where all
// move together, it is far more than two neighbours move against each other.
struct RowTravel : Component<FaceContact, double, 1> {
  static constexpr ComponentInfo info{
      "travel", "m", "of both surfaces against each other since the row was made, at most"};
};
// Data per point of a row against another particle, contiguous: a touching point takes one or two cache lines.
struct ContactPoint : Component<FaceContact, double, 5 * face_points> {
  static constexpr ComponentInfo info{"contact_point", "SI",
                                      "of each point: face of the other particle + u, v of the "
                                      "closest point; tangential spring x y z (history)"};
  enum Number {
    face_u,      // -, face + u, 0 <= u < 1
    v,           // -
    spring,      // m, its x
    numbers = 5  // per point
  };
};
// Only in scenes with output.contacts.
struct ContactPointForce : Component<FaceContact, double, 3 * face_points> {
  static constexpr ComponentInfo info{"contact_point_force", "N",
                                      "on the sampled face: x y z of each point"};
};

// ---- pairs of particles ------------------------------------------------------------------------------
// The rows of one particle against one other, or one of its periodic images. Built with the rows, which are sorted by
// (particle, other, image, face).
struct FacePairs {
  static constexpr const char* resource_name = "face_pairs";
  std::vector<std::int32_t> begin{0};     // [pairs + 1] into rows
  std::vector<std::int32_t> other_begin;  // [slots + 1] into of_other
  std::vector<std::int32_t> of_other;     // pairs with this particle as the other one

  int count() const { return static_cast<int>(begin.size()) - 1; }
  // The first pair whose rows begin at this row or later.
  int from_row(std::int32_t row) const {
    return static_cast<int>(std::ranges::lower_bound(begin, row) - begin.begin());
  }
  // From the keys of the rows: slot, face, other for each; `images`: three numbers for each, none without a cell; `begins`:
  // slots + 1.
  void list(std::span<const std::int32_t> keys, std::span<const std::int32_t> images,
            std::size_t begins) {
    const auto other_image = [&](std::size_t k) {
      return !images.empty() &&
             !std::equal(images.data() + k - 3, images.data() + k, images.data() + k);
    };
    std::vector<std::int32_t> other;  // [pairs]
    begin.assign(1, 0);
    for (std::size_t k = 0; k < keys.size(); k += 3) {
      if (k == 0 || keys[k - 3] != keys[k] || keys[k - 1] != keys[k + 2] || other_image(k)) {
        other.push_back(keys[k + 2]);
        begin.push_back(0);
      }
      begin.back() = static_cast<std::int32_t>(k / 3) + 1;
    }
    other_begin.assign(begins, 0);
    for (const std::int32_t slot : other) entry(other_begin, slot + 1) += 1;
    std::partial_sum(other_begin.begin(), other_begin.end(), other_begin.begin());
    std::vector<std::int32_t> next = other_begin;
    of_other.resize(other.size());
    for (std::size_t p = 0; p < other.size(); ++p)
      entry(of_other, entry(next, other[p])++) = static_cast<std::int32_t>(p);
  }
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(begin, other_begin, of_other);
  }
};

// Loads from the points of each pair on the faces of both particles: recomputed in every step.
struct PairLoads {
  static constexpr const char* resource_name = "pair_loads";
  struct alignas(64) Load {
    std::array<double, face_numbers> force;  // N, on the face's Bezier points: all x, y, z
    Load() {}                                // set once the last point of the face has been added
  };
  struct Pair {
    std::vector<std::array<double, 3>> own;  // N, on the touching points, row after row
    std::vector<std::int32_t> face;          // loaded faces of the other particle
    std::vector<Load> load;                  // [face]

    void clear() {
      own.clear();
      face.clear();
      load.clear();
    }
  };
  std::vector<Pair> pairs;

  template <class Bytes>
  void state(Bytes&) {}
};

// ---- tools that are not planes ----------------------------------------------------------------------
// Tool triangles that a face can touch: a range in TriangleLists.
struct TriangleRange : Component<FaceToolContact, std::int32_t, 2> {
  static constexpr ComponentInfo info{"triangles", "-", "first in the list, and the end"};
};

}  // namespace pulvis::space

// The periodic cell: a powder that extends infinitely in all directions, of which one period is stored. Particles are
// stored once and unsplit, and are not wrapped when they cross a border; a contact row records which periodic image of
// the other particle it refers to.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "components/contact.hpp"
#include "components/servo.hpp"
#include "components/shape.hpp"

namespace pulvis {

struct ContactImage : Component<Contact, std::int32_t, 2> {
  static constexpr ComponentInfo info{
      "image", "-", "periods by which the other particle is moved along both vectors of the cell"};
};
struct MassCentre : Component<Particle, double, 2> {
  static constexpr ComponentInfo info{"mass_centre", "m", "where its centre of mass is"};
};
struct NetForce : Component<Particle, double, 2> {
  static constexpr ComponentInfo info{"net_force", "N", "sum of the contact forces on it"};
};
struct StrainResistance : Component<Particle, double, 2> {
  static constexpr ComponentInfo info{
      "strain_resistance", "SI",
      "of its sampled contacts against a strain of the cell: springs, N m; dashpots, N m s"};
};
struct KickWork : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"kick_work", "J",
                                      "kinetic energy from the last change of the cell's speed"};
};

using Image = std::array<std::int32_t, 2>;

// xx xy yx yy, as in x_i = T_ij y_j.
struct Tensor2 {
  std::array<double, 4> t{};
  Point operator*(const Point& p) const {
    return {t[0] * p[0] + t[1] * p[1], t[2] * p[0] + t[3] * p[1]};
  }
  Point operator*(const Image& n) const {
    return *this * Point{static_cast<double>(n[0]), static_cast<double>(n[1])};
  }
  Tensor2 operator*(const Tensor2& o) const {
    return {{t[0] * o.t[0] + t[1] * o.t[2], t[0] * o.t[1] + t[1] * o.t[3],
             t[2] * o.t[0] + t[3] * o.t[2], t[2] * o.t[1] + t[3] * o.t[3]}};
  }
  double determinant() const { return t[0] * t[3] - t[1] * t[2]; }
  Tensor2 inverse() const {
    const double d = 1 / determinant();
    return {{d * t[3], -d * t[1], -d * t[2], d * t[0]}};
  }
  friend Tensor2 operator+(const Tensor2& a, const Tensor2& b) {
    Tensor2 sum;
    for (std::size_t i = 0; i < 4; ++i) sum.t[i] = a.t[i] + b.t[i];
    return sum;
  }
  friend Tensor2 operator*(double s, const Tensor2& a) {
    Tensor2 scaled;
    for (std::size_t i = 0; i < 4; ++i) scaled.t[i] = s * a.t[i];
    return scaled;
  }
  // a_ij b_ij
  friend double product(const Tensor2& a, const Tensor2& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += a.t[i] * b.t[i];
    return sum;
  }
};

// Mixed strain and stress control of the whole powder: the targets of its stages, and the progress so
// far. Used for a periodic cell, or for the four planes of a die.
struct MixedControl {
  enum Part { xx, yy, xy, parts };  // tensor components, each strain- or stress-controlled
  enum class Law {
    strain,  // strain-controlled
    stress,  // stress-controlled
    ratio,   // xx: kept at this ratio to the stress yy
    mean     // xx: the mean of xx and yy is kept
  };
  struct Stage {
    double duration = 0;                 // s, planned
    double ramp = 0.1;                   // -, share of the duration
    double rise = 0;                     // s, until the full target stress is reached
    double tolerance = 0.05;             // -, relative to the largest stress
    std::array<Law, parts> law{};        //
    std::array<double, parts> strain{};  // -, over the stage: integral of the rate of deformation
    std::array<double, parts> stress{};  // Pa, tension > 0; for a ratio: -
    double rotation = 0;                 // rad, over the stage
    double mass = 0;                     // kg m^2, minimum for a servo
    double damping = 0;                  // N m s, of its dashpot at that mass

    bool holds_stress() const {
      return law[xx] != Law::strain || law[yy] != Law::strain || law[xy] != Law::strain;
    }
  };
  struct Servo {          // of one stress-controlled component (systems/tools/servo_kernel.hpp)
    double mass = 0;      // kg m^2
    double speed = 0;     // 1/s
    double dragged = 0;   // 1/s, of the mass coupled through the dashpot
    double at_begin = 0;  // Pa, at the start of the stage
    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(mass, speed, dragged, at_begin);
    }
  };

  // From the scene
  std::vector<Stage> stages;

  // State of the run
  std::array<double, parts> strain{};  // integral of the rate of deformation so far
  double rotation = 0;                 // rad, integral of the spin
  std::array<double, parts> stress{};  // Pa
  std::array<double, parts> asked{};   // Pa, target
  std::array<Servo, parts> servos{};
  std::array<ServoWatch, parts> watches{};
  std::size_t stage = static_cast<std::size_t>(-1);      // stage of the last step
  double cut = std::numeric_limits<double>::infinity();  // s: when its strain rates start to fall

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(strain, rotation, stress, asked, servos, watches, stage, cut);
  }
};

struct PeriodicCell {
  static constexpr const char* resource_name = "periodic_cell";

  // From the scene
  Point centre{};        // m, centre of mass of the powder: the centre of the homogeneous motion
  Point corner{};        // -, corner of the initial cell relative to the centre, in cell vectors
  double thickness = 0;  // m

  // State of the run
  MixedControl control;
  Tensor2 vectors;  // m, cell vectors as columns
  Tensor2 rate;  // m/s, of the cell vectors, over the last step; the next one once forces are known
  Tensor2 gradient;      // 1/s, velocity gradient over the same step
  Tensor2 next;          // m, cell vectors at the end of the step
  Tensor2 change;        // 1/s, of the homogeneous velocity field, from the last step to the next
  Tensor2 border_force;  // N: sum over the contacts of force on the sampled side times image vector

  double area() const { return std::abs(vectors.determinant()); }
  // m: follows the homogeneous motion about the centre, as the particles do on average. In a periodic powder any corner
  // would do; with this one few particles leave the cell.
  Point corner_now() const {
    const Point way = vectors * corner;
    return {centre[0] + way[0], centre[1] + way[1]};
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(control, vectors.t, rate.t, gradient.t, next.t, change.t, border_force.t);
  }
};

// The four planes of a die, driven like the borders of a cell: by strains or stresses, about the centre between them.
struct DrivenWalls {
  static constexpr const char* resource_name = "driven_walls";
  int left = 0, right = 0, bottom = 0, top = 0;  // tool numbers
  double thickness = 0;                          // m
  MixedControl control;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(control);
  }
};

}  // namespace pulvis

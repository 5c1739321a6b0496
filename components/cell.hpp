// The periodic cell: a powder that extends infinitely in all directions, of which one period is stored. Particles are
// stored once and unsplit, and are not wrapped when they cross a border; a contact row records which periodic image of
// the other particle it refers to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "components/contact.hpp"
#include "components/dimension.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/shape.hpp"
#include "engine/world.hpp"

namespace pulvis {

// At: Contact or FaceContact.
template <class At>
struct ContactImage : Component<At, std::int32_t, At::axes> {
  static constexpr ComponentInfo info{
      "image", "-", "periods by which the other particle is moved along each vector of the cell"};
};
template <class D>
struct MassCentre : Component<Particle, double, D::axes> {
  static constexpr ComponentInfo info{"mass_centre", "m", "where its centre of mass is"};
};
template <class D>
struct NetForce : Component<Particle, double, D::axes> {
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

// Periods along each vector of the cell.
template <class D>
using ImageIn = std::array<std::int32_t, D::axes>;

// visit(image) for all between two, both included, in ascending order.
template <class D, class Visit>
void for_images(const ImageIn<D>& first, const ImageIn<D>& last, const Visit& visit) {
  ImageIn<D> image = first;
  for (;;) {
    visit(image);
    std::size_t k = D::axes;
    while (k > 0 && image[k - 1] == last[k - 1]) {
      image[k - 1] = first[k - 1];
      --k;
    }
    if (k == 0) return;
    image[k - 1] += 1;
  }
}

// Row by row, as in x_i = T_ij y_j: xx xy yx yy in two dimensions.
template <class D>
struct Tensor {
  static constexpr std::size_t n = D::axes;
  using Vector = typename D::Point;
  std::array<double, n * n> t{};

  double& operator()(std::size_t i, std::size_t j) { return t[n * i + j]; }
  double operator()(std::size_t i, std::size_t j) const { return t[n * i + j]; }
  static constexpr Tensor one() {
    Tensor unit;
    for (std::size_t i = 0; i < n; ++i) unit.t[n * i + i] = 1;
    return unit;
  }
  Vector column(std::size_t j) const {
    Vector v;
    for (std::size_t i = 0; i < n; ++i) v[i] = (*this)(i, j);
    return v;
  }
  Vector operator*(const Vector& v) const {
    Vector product{};
    for (std::size_t i = 0; i < n; ++i) {
      product[i] = (*this)(i, 0) * v[0];
      for (std::size_t j = 1; j < n; ++j) product[i] += (*this)(i, j) * v[j];
    }
    return product;
  }
  Vector operator*(const ImageIn<D>& image) const {
    Vector v;
    for (std::size_t i = 0; i < n; ++i) v[i] = static_cast<double>(image[i]);
    return *this * v;
  }
  Tensor operator*(const Tensor& o) const {
    Tensor product;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        product(i, k) = (*this)(i, 0) * o(0, k);
        for (std::size_t j = 1; j < n; ++j) product(i, k) += (*this)(i, j) * o(j, k);
      }
    return product;
  }
  Tensor transposed() const {
    Tensor swapped;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) swapped(j, i) = (*this)(i, j);
    return swapped;
  }
  double determinant() const {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += (*this)(0, j) * cofactor(0, j);
    return sum;
  }
  Tensor inverse() const {
    const double d = 1 / determinant();
    Tensor inverted;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) inverted(j, i) = d * cofactor(i, j);
    return inverted;
  }
  friend Tensor operator+(const Tensor& a, const Tensor& b) {
    Tensor sum;
    for (std::size_t i = 0; i < n * n; ++i) sum.t[i] = a.t[i] + b.t[i];
    return sum;
  }
  friend Tensor operator*(double s, const Tensor& a) {
    Tensor scaled;
    for (std::size_t i = 0; i < n * n; ++i) scaled.t[i] = s * a.t[i];
    return scaled;
  }
  // a_ij b_ij
  friend double product(const Tensor& a, const Tensor& b) {
    double sum = 0;
    for (std::size_t i = 0; i < n * n; ++i) sum += a.t[i] * b.t[i];
    return sum;
  }

 private:
  double cofactor(std::size_t i, std::size_t j) const {
    if constexpr (n == 2) {
      const double minor = (*this)(1 - i, 1 - j);
      return i == j ? minor : -minor;
    } else {
      const std::size_t a = (i + 1) % n, b = (i + 2) % n, c = (j + 1) % n, d = (j + 2) % n;
      return (*this)(a, c) * (*this)(b, d) - (*this)(a, d) * (*this)(b, c);
    }
  }
};

// Mixed strain and stress control of the whole powder: the targets of its stages, and the progress so
// far. Used for a periodic cell, or for the planes of a die.
struct MixedControl {
  // Tensor components, each strain- or stress-controlled. In two dimensions those with z have no strain.
  enum Part { xx, yy, zz, xy, yz, zx, parts };
  enum class Law {
    strain,  // strain-controlled
    stress,  // stress-controlled
    ratio,   // lateral: kept at this ratio to the axial stress
    mean     // lateral: all equal, so that the mean of the normal stresses is kept
  };
  static constexpr bool is_shear(int part) { return part >= xy; }
  struct Stage {
    double duration = 0;                 // s, planned
    double ramp = 0.1;                   // -, share of the duration
    double rise = 0;                     // s, until the full target stress is reached
    double tolerance = 0.05;             // -, relative to the largest stress
    std::array<Law, parts> law{};        //
    std::array<double, parts> strain{};  // -, over the stage: integral of the rate of deformation
    std::array<double, parts> stress{};  // Pa, tension > 0; for a ratio: -
    Point3 rotation{};                   // rad, over the stage: integral of the spin
    double mass = 0;                     // kg m^2, minimum for a servo
    double damping = 0;                  // N m s, of its dashpot at that mass

    bool holds_stress() const {
      return std::ranges::any_of(law, [](Law l) { return l != Law::strain; });
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
  int axes = 2;  // of the scene
  // The direction in which powders are pressed by most machines: y in the plane, z in space.
  Part axial() const { return axes == 2 ? yy : zz; }

  // State of the run
  std::array<double, parts> strain{};  // integral of the rate of deformation so far
  Point3 rotation{};                   // rad, integral of the spin
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

template <class D>
struct PeriodicCell {
  static constexpr const char* resource_name = "periodic_cell";
  using Vector = typename D::Point;

  // From the scene
  Vector centre{};       // m, centre of mass of the powder: the centre of the homogeneous motion
  Vector corner{};       // -, corner of the initial cell relative to the centre, in cell vectors
  double thickness = 1;  // m; 1 in three dimensions

  // State of the run
  MixedControl control;
  Tensor<D> vectors;  // m, cell vectors as columns
  Tensor<D>
      rate;  // m/s, of the cell vectors, over the last step; the next one once forces are known
  Tensor<D> gradient;  // 1/s, velocity gradient over the same step
  Tensor<D> next;      // m, cell vectors at the end of the step
  Tensor<D> change;    // 1/s, of the homogeneous velocity field, from the last step to the next
  Tensor<D>
      border_force;  // N: sum over the contacts of force on the sampled side times image vector

  // m^2, or m^3 in three dimensions
  double size() const { return std::abs(vectors.determinant()); }
  double volume() const { return size() * thickness; }  // m^3
  // m: follows the homogeneous motion about the centre, as the particles do on average. In a periodic powder any corner
  // would do; with this one few particles leave the cell.
  Vector corner_now() const {
    Vector at = vectors * corner;
    for (std::size_t k = 0; k < D::axes; ++k) at[k] += centre[k];
    return at;
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(control, vectors.t, rate.t, gradient.t, next.t, change.t, border_force.t);
  }
};

// act(cell) with the periodic cell of either dimension; false if there is none.
template <class Act>
bool with_cell_of(const World& world, const Act& act) {
  if (world.has<PeriodicCell<TwoD>>())
    act(world.resource<PeriodicCell<TwoD>>());
  else if (world.has<PeriodicCell<ThreeD>>())
    act(world.resource<PeriodicCell<ThreeD>>());
  else
    return false;
  return true;
}
// Of its images: 2 or 3; 0 without a periodic cell.
inline std::size_t cell_axes(const World& world) {
  std::size_t axes = 0;
  with_cell_of(world, [&](const auto& cell) { axes = cell.vectors.n; });
  return axes;
}

// The planes of a die, driven like the borders of a cell: by strains or stresses, about the centre between them.
struct DrivenWalls {
  static constexpr const char* resource_name = "driven_walls";
  struct Axis {
    int low = 0, high = 0;  // tool numbers
  };
  std::vector<Axis> walls;  // along x, y, and z in three dimensions
  double thickness = 1;     // m; 1 in three dimensions
  MixedControl control;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(control);
  }
};

}  // namespace pulvis

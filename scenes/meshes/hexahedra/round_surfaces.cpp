#include "scenes/meshes/hexahedra/round_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;

class EllipsoidSurface final : public StarSurface {
 public:
  explicit EllipsoidSurface(const Vec3& half) : half_(half) {}
  double radius(const Vec3& d) const override { return 1 / d.cwiseQuotient(half_).norm(); }
  Vec3 normal(const Vec3& d) const override {
    return d.cwiseQuotient(half_.cwiseProduct(half_)).normalized();
  }
  Vec3 half_size() const override { return half_; }
  double volume() const override { return 4 * pi / 3 * half_.prod(); }

 private:
  Vec3 half_;
};

class SuperquadricSurface final : public StarSurface {
 public:
  SuperquadricSurface(const Vec3& half, double e, double f) : half_(half), e_(e), f_(f) {}
  // The left side F of its equation is homogeneous of order f.
  double radius(const Vec3& d) const override {
    const Vec3 s = d.cwiseQuotient(half_).cwiseAbs();
    const double round = portable::pow(s.x(), e_) + portable::pow(s.y(), e_);
    const double sum = portable::pow(round, f_ / e_) + portable::pow(s.z(), f_);
    return portable::pow(sum, -1 / f_);
  }
  // grad F over f. (s_x^e + s_y^e)^(f/e - 1) may be infinite at the poles, where its factor is 0.
  Vec3 normal(const Vec3& d) const override {
    const Vec3 s = d.cwiseQuotient(half_).cwiseAbs();
    const double round = portable::pow(s.x(), e_) + portable::pow(s.y(), e_);
    const double outer = round > 0 ? portable::pow(round, f_ / e_ - 1) : 0;
    const Vec3 gradient(outer * portable::pow(s.x(), e_ - 1), outer * portable::pow(s.y(), e_ - 1),
                        portable::pow(s.z(), f_ - 1));
    const Vec3 sign = d.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
    return gradient.cwiseQuotient(half_).cwiseProduct(sign).normalized();
  }
  Vec3 half_size() const override { return half_; }
  double roundness() const override { return 5.6 / (e_ * e_ * e_) * (1 - 2 / f_); }
  // Jaklic, Leonardis & Solina (2000), eq. 2.60, with the exponents 2/eps1 = f and 2/eps2 = e.
  double volume() const override {
    const double eps1 = 2 / f_, eps2 = 2 / e_;
    return 2 * half_.prod() * eps1 * eps2 * euler_beta(eps1 / 2 + 1, eps1) *
           euler_beta(eps2 / 2, eps2 / 2);
  }

 private:
  static double log_gamma(double x) { return portable::log_gamma(x + 1) - portable::log(x); }
  static double euler_beta(double x, double y) {
    return portable::exp(log_gamma(x) + log_gamma(y) - log_gamma(x + y));
  }

  Vec3 half_;
  double e_, f_;
};

// A cylinder with rounded rims: the points within `rounding` of a smaller one.
class CylinderSurface final : public StarSurface {
 public:
  CylinderSurface(double radius, double half_height, double rounding)
      : radius_(radius), half_height_(half_height), rounding_(rounding) {}
  double radius(const Vec3& d) const override {
    const double across = portable::hypot(d.x(), d.y()), up = std::abs(d.z());
    if (up * radius_ <= inner_height() * across) return radius_ / across;
    if (across * half_height_ <= inner_radius() * up) return half_height_ / up;
    const double along = across * inner_radius() + up * inner_height();
    const double off = across * inner_height() - up * inner_radius();
    return along + std::sqrt(std::max(rounding_ * rounding_ - off * off, 0.0));
  }
  Vec3 normal(const Vec3& d) const override {
    const Vec3 p = radius(d) * d;
    const double across = portable::hypot(p.x(), p.y());
    const double side = across > inner_radius() ? 1 - inner_radius() / across : 0;
    const double up = std::max(std::abs(p.z()) - inner_height(), 0.0);
    if (side == 0 && up == 0) return d;  // on a sharp rim, up to round-off
    return Vec3(side * p.x(), side * p.y(), p.z() < 0 ? -up : up).normalized();
  }
  Vec3 half_size() const override { return {radius_, radius_, half_height_}; }
  // A value below 1 leaves the elements an angle where a corner of the cube lies on the rim. The excess extends
  // past the rim, farther in a long cylinder.
  double roundness() const override { return 1 - 0.3 * std::min(1.0, radius_ / half_height_); }
  // Steiner's formula: volume, area and integral of the mean curvature of the smaller cylinder.
  double volume() const override {
    const double r = inner_radius(), h = 2 * inner_height(), w = rounding_;
    return pi * r * r * h + w * 2 * pi * r * (r + h) + w * w * pi * (h + pi * r) +
           4 * pi / 3 * w * w * w;
  }

 private:
  double inner_radius() const { return radius_ - rounding_; }
  double inner_height() const { return half_height_ - rounding_; }
  double radius_, half_height_, rounding_;
};

}  // namespace

std::unique_ptr<StarSurface> round_surface(const SphereShape& s) {
  return std::make_unique<EllipsoidSurface>(Vec3::Constant(s.diameter / 2));
}
std::unique_ptr<StarSurface> round_surface(const EllipsoidShape& s) {
  return std::make_unique<EllipsoidSurface>(s.size / 2);
}
std::unique_ptr<StarSurface> round_surface(const SuperquadricShape& s) {
  return std::make_unique<SuperquadricSurface>(s.size / 2, s.exponent_xy, s.exponent_z);
}
std::unique_ptr<StarSurface> round_surface(const CylinderShape& s) {
  return std::make_unique<CylinderSurface>(s.diameter / 2, s.height / 2, s.rounding);
}

}  // namespace pulvis::space

// Stabilisation of the twelve hourglass modes of the one-point hexahedron: bending and twisting as three families of
// plates, and the xi eta zeta mode. Physical stabilisation: assumed strains with the material's moduli, free of
// parasitic shear in bending and of volume changes.
//
// Source   Modes: Flanagan & Belytschko (1981). Assumed strains: ASQBI of Belytschko & Bindeman (1993), with each strain
//          that is linear in one coordinate as that of a plate across it (plane stress), and of fibres of any angle
//          as in Pian & Sumihara (1984). Limit: systems/space/body/j2_hourglass_kernel.hpp
// Symbols  a_1 a_2 a_3  half the undeformed edges at the centre
//          p_m    (a_i . F^-1 h_m / |a_i|^2)_i minus its undeformed value, m: eta zeta, zeta xi, xi eta,
//                 xi eta zeta [-]; h_m = x_m/8. Zero in every homogeneous deformation, and invariant to rotation
//          Plate across i, fibres along j and k at an angle of cosine c, strains at xi_i = 1 in the axes halfway between
//          them:
//            e_j = p_ij . j,  e_k = p_ik . k,  gamma = |a_j|/|a_k| p_ik . j + |a_k|/|a_j| p_ij . k
//            sum        = (e_j + e_k - c gamma)/(1 - c^2)        (e_11 + e_22)
//            difference = (e_j - e_k)/sqrt(1 - c^2)              (e_11 - e_22)
//            shear      = (gamma - c (e_j + e_k))/(1 - c^2)      (2 e_12)
//          B = E/(2(1 - nu)), mu: moduli of sum; of difference and shear.  E: of p of xi eta zeta
// Energy   per undeformed volume: sum over the plates (B sum^2 + mu (difference^2 + shear^2))/6 + E p_4^2/18, the
//          mean squares of xi_i and xi_j xi_k being 1/3 and 1/9
#pragma once

#include "systems/space/body/element_kernel.hpp"

namespace pulvis::space::kernels {

template <class T>
struct PlateMode {  // strains, or stresses
  T sum, difference, shear;
};
template <class T>
struct Hourglass {
  PlateMode<T> plate1, plate2, plate3;  // across xi, eta, zeta
  Vector3<T> last;                      // of xi eta zeta
};

// Calls f(component of a, component of b) for all twelve components, and collects the results.
template <class T, class F>
PlateMode<T> each_number(const PlateMode<T>& a, const PlateMode<T>& b, const F& f) {
  return {f(a.sum, b.sum), f(a.difference, b.difference), f(a.shear, b.shear)};
}
template <class T, class F>
Hourglass<T> each_number(const Hourglass<T>& a, const Hourglass<T>& b, const F& f) {
  return {each_number(a.plate1, b.plate1, f), each_number(a.plate2, b.plate2, f),
          each_number(a.plate3, b.plate3, f),
          Vector3<T>{f(a.last.x, b.last.x), f(a.last.y, b.last.y), f(a.last.z, b.last.z)}};
}

template <class T>
struct HourglassModuli {
  T plate, shear, last;  // Pa: B, mu, E
};
template <class T>
HourglassModuli<T> hourglass_moduli(T mu, T bulk) {
  const T nine = 9.0 * bulk * mu;
  return {nine / fma(bulk, 3.0, 4.0 * mu), mu, nine / fma(bulk, 3.0, mu)};
}

// ---- strains ---------------------------------------------------------------------------------------------
// fibre F^-1: maps modes to components along the fibres.
template <class T>
Matrix3<T> to_fibres(const Tensor& fibre, const Matrix3<T>& adj, T inv_det) {
  return scaled(product(fibre, adj), inv_det);
}

template <class T>
Vector3<T> fibre_components(const Matrix3<T>& to, const Vector3<T>& mode, const Point& natural) {
  const Vector3<T> p = product(to, mode);
  return {p.x - natural[0], p.y - natural[1], p.z - natural[2]};
}

template <class T>
PlateMode<T> plate_strain(T e_j, T e_k, T j_of_k, T k_of_j, const Shape::Element::Plane& plane) {
  const T both = e_j + e_k, gamma = fma(j_of_k, plane.ratio, k_of_j * plane.inv_ratio);
  return {plane.inv_sine2 * fma(gamma, -plane.cosine, both), plane.inv_sine * (e_j - e_k),
          plane.inv_sine2 * fma(both, -plane.cosine, gamma)};
}

template <class T>
struct HourglassComponents {  // p
  Vector3<T> ez, zx, xe, xez;
};
template <class T>
HourglassComponents<T> hourglass_components(const ElementModes<T>& m, const Matrix3<T>& to,
                                            const Shape::Element& e) {
  return {fibre_components(to, Vector3<T>{m.x.ez, m.y.ez, m.z.ez}, e.natural[0]),
          fibre_components(to, Vector3<T>{m.x.zx, m.y.zx, m.z.zx}, e.natural[1]),
          fibre_components(to, Vector3<T>{m.x.xe, m.y.xe, m.z.xe}, e.natural[2]),
          fibre_components(to, Vector3<T>{m.x.xez, m.y.xez, m.z.xez}, e.natural[3])};
}

template <class T>
Hourglass<T> hourglass_strain(const HourglassComponents<T>& p, const Shape::Element& e) {
  return {plate_strain(p.xe.y, p.zx.z, p.zx.y, p.xe.z, e.plane[0]),
          plate_strain(p.ez.z, p.xe.x, p.xe.z, p.ez.x, e.plane[1]),
          plate_strain(p.zx.x, p.ez.y, p.ez.x, p.zx.y, e.plane[2]), p.xez};
}

template <class T>
PlateMode<T> plate_stress(const PlateMode<T>& e, const HourglassModuli<T>& moduli) {
  return {moduli.plate * e.sum, moduli.shear * e.difference, moduli.shear * e.shear};
}
template <class T>
Hourglass<T> hourglass_stress(const Hourglass<T>& e, const HourglassModuli<T>& moduli) {
  return {plate_stress(e.plate1, moduli), plate_stress(e.plate2, moduli),
          plate_stress(e.plate3, moduli),
          Vector3<T>{moduli.last * e.last.x, moduli.last * e.last.y, moduli.last * e.last.z}};
}

// Twice the stored energy, per undeformed volume: stress times strain.
template <class T>
T hourglass_product(const Hourglass<T>& a, const Hourglass<T>& b) {
  const auto plate = [](const PlateMode<T>& x, const PlateMode<T>& y) {
    return fma(x.sum, y.sum, fma(x.difference, y.difference, x.shear * y.shear));
  };
  const T plates =
      plate(a.plate1, b.plate1) + plate(a.plate2, b.plate2) + plate(a.plate3, b.plate3);
  const T last = fma(a.last.x, b.last.x, fma(a.last.y, b.last.y, a.last.z * b.last.z));
  return (1.0 / 3.0) * fma(last, 1.0 / 3.0, plates);
}

// ---- forces: the exact derivative of the energy ------------------------------------------------------------
template <class T>
struct PlateForce {  // conjugate to e_j, e_k, and to p_ik . j and p_ij . k
  T j, k, j_of_k, k_of_j;
};
template <class T>
PlateForce<T> plate_force(const PlateMode<T>& s, const Shape::Element::Plane& plane) {
  const T both = plane.inv_sine2 * fma(s.shear, -plane.cosine, s.sum);
  const T gamma = plane.inv_sine2 * fma(s.sum, -plane.cosine, s.shear);
  const T one = plane.inv_sine * s.difference;
  return {both + one, both - one, gamma * plane.ratio, gamma * plane.inv_ratio};
}

template <class T>
struct HourglassForce {  // of the modes: derivatives with respect to x_m
  Vector3<T> ez, zx, xe, xez;
};

template <class T>
HourglassForce<T> hourglass_force(const Hourglass<T>& s, const Matrix3<T>& to,
                                  const Shape::Element& e) {
  const auto one = plate_force(s.plate1, e.plane[0]), two = plate_force(s.plate2, e.plane[1]),
             three = plate_force(s.plate3, e.plane[2]);
  const Matrix3<T> third = scaled(to, T{} + (1.0 / 3.0) * e.volume);
  const auto back = [&](T x, T y, T z) { return transposed_product(third, Vector3<T>{x, y, z}); };
  constexpr double ninth = 1.0 / 3.0;
  return {back(three.j_of_k + two.k_of_j, three.k, two.j),
          back(three.j, one.j_of_k + three.k_of_j, one.k),
          back(two.k, one.j, two.j_of_k + one.k_of_j),
          back(ninth * s.last.x, ninth * s.last.y, ninth * s.last.z)};
}

// Contribution of the mode forces through F in p: -sum y (x) x_m F^-T. Here without F^-T.
template <class T>
Matrix3<T> hourglass_moment(const HourglassForce<T>& y, const ElementModes<T>& m) {
  const auto of = [&](T ez, T zx, T xe, T xez, const Modes<T>& x) {
    return fma(ez, x.ez, fma(zx, x.zx, fma(xe, x.xe, xez * x.xez)));
  };
  const auto row = [&](T ez, T zx, T xe, T xez) {
    return Vector3<T>{of(ez, zx, xe, xez, m.x), of(ez, zx, xe, xez, m.y), of(ez, zx, xe, xez, m.z)};
  };
  const auto x = row(y.ez.x, y.zx.x, y.xe.x, y.xez.x), yy = row(y.ez.y, y.zx.y, y.xe.y, y.xez.y),
             z = row(y.ez.z, y.zx.z, y.xe.z, y.xez.z);
  return {x.x, x.y, x.z, yy.x, yy.y, yy.z, z.x, z.y, z.z};
}

}  // namespace pulvis::space::kernels

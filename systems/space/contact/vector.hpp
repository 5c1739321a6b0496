// Three-dimensional vectors whose components are doubles or lanes.
#pragma once

#include "engine/lane.hpp"

namespace pulvis::space::kernels {

using pulvis::fma;  // for doubles and lanes, next to the vector version
using pulvis::select;

template <class T>
struct Vector {
  T x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator*(const T& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
};

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
// s a + b
template <class T>
Vector<T> fma(const T& s, const Vector<T>& a, const Vector<T>& b) {
  return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
}
template <class Mask, class T>
Vector<T> select(const Mask& mask, const Vector<T>& yes, const Vector<T>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}  // namespace pulvis::space::kernels

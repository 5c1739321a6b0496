// The dimensions of a scene. What both have in common is written once, with one of these as its parameter D.
#pragma once

#include <array>

namespace pulvis {

struct Shape;
struct Contact;
struct ControlPoint;
struct SurfaceFace;
struct ToolContact;
struct FaceContact;
struct FaceToolContact;
struct CurvePosition;
struct CurveVelocity;
struct CurveBefore;
namespace space {
struct Shape;
struct SurfacePosition;
struct SurfaceVelocity;
struct SurfaceBefore;
}  // namespace space

struct TwoD {
  static constexpr int axes = 2;
  using Point = std::array<double, 2>;
  using Shape = pulvis::Shape;
  // Entity types of the candidates: between particles, and with tools.
  using Contact = pulvis::Contact;
  using ToolContact = pulvis::ToolContact;
  // The smooth outlines of the particles: contact curves.
  using OutlinePart = ControlPoint;  // an edge, given by its first control point
  using OutlinePosition = CurvePosition;
  using OutlineVelocity = CurveVelocity;
  using OutlineBefore = CurveBefore;
};

struct ThreeD {
  static constexpr int axes = 3;
  using Point = std::array<double, 3>;
  using Shape = space::Shape;
  using Contact = FaceContact;
  using ToolContact = FaceToolContact;
  // Contact surfaces.
  using OutlinePart = SurfaceFace;
  using OutlinePosition = space::SurfacePosition;
  using OutlineVelocity = space::SurfaceVelocity;
  using OutlineBefore = space::SurfaceBefore;
};

}  // namespace pulvis

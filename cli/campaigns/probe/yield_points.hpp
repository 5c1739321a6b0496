// Where a powder yields, by its probes.
#pragma once

#include <optional>
#include <vector>

#include "cli/campaigns/probe/powder_moduli.hpp"

namespace pulvis {

struct YieldPoint {
  ProbeDirection direction;
  Axis axis = Axis::y;              // of pressing
  Mandel stress = Mandel::Zero();   // Pa
  Mandel plastic = Mandel::Zero();  // unit: direction of the plastic strain there
  // rad, between it and the normal of the surface through the neighbours, in the plane of the axis (AxialPlane)
  std::optional<double> normality = {};
  double pressure() const;    // Pa, -(xx + yy + zz)/3
  double deviatoric() const;  // Pa, von Mises; > 0 if compressed more along the axis than across it
  double plane_pressure() const;  // Pa, -(xx + yy)/2
  double plane_shear() const;     // Pa, (xx - yy)/2
  // Pa, by which open points are told. In two dimensions that of the plane, since zz stays locked in the particles when
  // they come apart.
  double opening_pressure() const;
};

// Where the plastic strain reaches `offset`; none: never.
std::optional<YieldPoint> offset_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                       double offset);
// Where `energy`, J/m^3, has been dissipated.
std::optional<YieldPoint> dissipation_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                            double energy);

// Computes the angles to the normals of the points in the axial plane: in the order of their stress directions from
// `centre` they form a surface; the tangent at a point is the line through its neighbours. The surface is open where one of
// the `directions`, evenly spaced over the full circle, has no point; points at its ends have a neighbour on one side only,
// and no angle.
void find_normality(std::vector<YieldPoint>& points, const Mandel& centre, int directions);

}  // namespace pulvis

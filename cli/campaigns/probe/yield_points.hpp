// Where a powder yields: moduli, yield points and plastic strains from its probe curves.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cli/campaigns/probe/probe_spec.hpp"

namespace pulvis {

// Strains and stresses along a probe, from its start; tension > 0.
struct ProbeCurve {
  double angle = 0;                           // rad, of (strain xx, strain yy), or of the stresses
  std::vector<std::array<double, 3>> strain;  // xx yy xy, since the probe began
  std::vector<std::array<double, 4>> stress;  // Pa: xx yy xy zz
  std::vector<double> dissipated;             // J/m^3, of bulk volume, since the probe began
};

// Of the bulk powder, pores included, for small unloadings. Plane strain: strain zz is zero.
struct PowderModuli {
  double c11 = 0, c12 = 0, c22 = 0;  // Pa: xx xx, xx yy (mean of both), yy yy
  double g = 0;                      // Pa: shear; 0: not probed
  // Of the closest isotropic solid to c11, c12, c22: G = ((c11 + c22)/2 - c12)/2, lambda = c12.
  double youngs_modulus() const;
  double poissons_ratio() const;
  bool are_of_a_solid() const;  // every strain costs energy (positive definite)
};

// Least squares of stress against strain over the parts of all curves below `elastic_strain`. `shear`: a probe in
// xy, may be null.
PowderModuli moduli_of(const std::vector<ProbeCurve>& curves, const ProbeCurve* shear,
                       double elastic_strain);

struct YieldPoint {
  double angle = 0;                 // rad, of the probe
  std::array<double, 4> stress{};   // Pa: xx yy xy zz
  std::array<double, 2> plastic{};  // unit vector: direction of the plastic strain xx, yy there
  std::optional<double>
      normality;            // rad, between it and the normal of the surface through the neighbours
  double pressure() const;  // Pa, -(xx + yy + zz)/3
  double deviatoric() const;      // Pa, von Mises; > 0 if yy is compressed more than xx
  double plane_pressure() const;  // Pa, -(xx + yy)/2
  double plane_shear() const;     // Pa, (xx - yy)/2
};

// Where the plastic strain reaches `offset`; none: never.
std::optional<YieldPoint> offset_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                       double offset);
// Where `energy`, J/m^3, has been dissipated.
std::optional<YieldPoint> dissipation_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                            double energy);

// Computes the angles to the normals: the points, in the order of their stress directions from `centre` (xx, yy), form a
// surface; the tangent at a point is the line through its neighbours. The surface is open where one of the `directions`,
// evenly spaced over the full circle, has no point; points at its ends have a neighbour on one side only, and no angle.
void find_normality(std::vector<YieldPoint>& points, const std::array<double, 2>& centre,
                    int directions);

}  // namespace pulvis

// Where a powder yields: moduli, yield points and plastic strains from the curves of its probes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scenes/probe/probe.hpp"

namespace pulvis {

// What a probe went through, from where it began; tension > 0.
struct ProbeCurve {
  double angle = 0;                           // rad, of (strain xx, strain yy), or of the stresses
  std::vector<std::array<double, 3>> strain;  // xx yy xy, since the probe began
  std::vector<std::array<double, 4>> stress;  // Pa: xx yy xy zz
  std::vector<double> dissipated;  // J/m^3, of the powder with its pores, since the probe began
};

// Of the powder with its pores, for small unloadings. Plane strain: zz cannot strain.
struct PowderModuli {
  double c11 = 0, c12 = 0, c22 = 0;  // Pa: xx xx, xx yy (mean of both), yy yy
  double g = 0;                      // Pa: shear; 0: not probed
  // Of the isotropic solid nearest to c11, c12, c22: G = ((c11 + c22)/2 - c12)/2, lambda = c12.
  double youngs_modulus() const;
  double poissons_ratio() const;
  bool are_of_a_solid() const;  // every strain costs energy
};

// Least squares of stress against strain over the parts of all curves with less than `elastic_strain`. `shear`: a probe in
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
  double deviatoric() const;      // Pa, von Mises; > 0 where yy is pressed more than xx
  double plane_pressure() const;  // Pa, -(xx + yy)/2
  double plane_shear() const;     // Pa, (xx - yy)/2
};

// Where the plastic strain reaches `offset`; none: it does not.
std::optional<YieldPoint> offset_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                       double offset);
// Where `energy` is dissipated, J/m^3.
std::optional<YieldPoint> dissipation_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                            double energy);

// Fills in the angles to the normals: the points in the order of the stresses' directions from `centre` (xx, yy) are a
// closed surface, whose tangent at a point is that through its neighbours.
void find_normality(std::vector<YieldPoint>& points, const std::array<double, 2>& centre);

}  // namespace pulvis

// The stiffness of a powder, from the elastic parts of its probes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "cli/campaigns/probe/mandel.hpp"
#include "cli/campaigns/probe/probe_directions.hpp"

namespace pulvis {

// Strains and stresses along a probe, from its start; tension > 0. In two dimensions strain zz and shears with z are zero.
struct ProbeCurve {
  ProbeDirection direction;
  std::vector<Mandel> strain;      // since the probe began
  std::vector<Mandel> stress;      // Pa
  std::vector<double> dissipated;  // J/m^3, of bulk volume, since the probe began
};

// Of the bulk powder, pores included, for small unloadings.
class PowderModuli {
 public:
  PowderModuli() = default;
  // c: Pa, in the components of Mandel. Those of `parts` have been probed; the others do not count.
  PowderModuli(const MandelMatrix& c, std::vector<int> parts, bool in_space);

  bool known() const { return !parts_.empty(); }
  bool in_space() const { return in_space_; }
  // Pa, of tensor components: 1 to 3 the normal ones, 4 to 6 xy, yz, zx. c(1, 2) relates stress xx to strain yy, and
  // c(4, 4) is the shear modulus.
  double c(int row, int column) const;
  bool has(int part) const;  // likewise 1 to 6
  bool is_complete() const { return parts_.size() == tensor_parts; }

  // Of the closest isotropic solid. In two dimensions, plane strain, by xx and yy only: G = ((c11 + c22)/2 - c12)/2, lambda =
  // c12; in three by the Frobenius norm (Moakher & Norris 2006).
  double youngs_modulus() const;
  double poissons_ratio() const;
  double bulk_modulus() const;   // Pa
  double shear_modulus() const;  // Pa

  // Of a complete stiffness.
  // -, Frobenius distance over the norm, to the closest solid of this symmetry: isotropic, transversely isotropic about z,
  // orthotropic along x, y and z.
  struct Misfits {
    double isotropic = 0, transverse = 0, orthotropic = 0;
  };
  Misfits misfits() const;
  // From the inverse: E_x E_y E_z, nu_xy nu_yz nu_xz (strain of the second axis by stress along the
  // first), G_xy G_yz G_zx.
  std::vector<std::pair<std::string, double>> engineering_constants() const;

  bool are_of_a_solid() const;  // every strain costs energy (positive definite)
  Mandel elastic_strain(const Mandel& stress) const;

 private:
  MandelMatrix c_ = MandelMatrix::Zero(), inverse_ = MandelMatrix::Zero();
  std::vector<int> parts_;
  bool in_space_ = false;
};

// Least squares of stress against strain over the parts of all curves below `elastic_strain`; the symmetric part.
PowderModuli moduli_of(const std::vector<ProbeCurve>& curves, bool in_space, double elastic_strain);

}  // namespace pulvis

// Fitted caps as input blocks for continuum codes. Units: Pa; densities are relative.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/campaigns/probe/cap_models.hpp"

namespace pulvis {

inline constexpr double degrees_in_radian = 180 / std::numbers::pi;

// A parameter of a block. One that the yield points do not determine has no number: the block says between which values
// it lies, and its user has to choose.
struct BlockValue {
  std::optional<double> value;  // Pa, rad or -
  std::string range = {};       // as written into the block: "R=0.2..2.1"
  BlockValue() = default;
  BlockValue(double known) : value(known) {}
  BlockValue(std::optional<double> maybe, std::string between)
      : value(maybe), range(std::move(between)) {}
};

// One density of a material: means over its seeds.
struct CapRow {
  double density = 0;         // -
  double youngs_modulus = 0;  // Pa
  double poissons_ratio = 0;
  BlockValue d = {};         // Pa, cohesion in the p-q plane
  BlockValue beta = {};      // rad
  BlockValue r = {};         // -, R
  BlockValue p_b = {};       // Pa
  BlockValue m = {};         // -, slope of the critical state line of modified Cam-Clay
  BlockValue p_c = {};       // Pa, its preconsolidation pressure
  double solid_density = 0;  // kg/m^3, of the particles; 0: not the same for all
};

// Abaqus: *ELASTIC and *CAP PLASTICITY against the relative density as field variable 1, *CAP HARDENING from p_b against the
// volumetric plastic strain ln(density / first density). Rows in order of increasing density.
std::string abaqus_block(const std::string& name, const std::vector<CapRow>& rows);

// The compression and swelling slopes of Cam-Clay, from the void ratio e = (1 - density)/density: lambda = -de/d ln(p_c) over
// all rows by least squares, kappa = (1 + e) p/K at p_c/2 with the bulk modulus of the middle row.
struct CamClay {
  double porosity = 0, lambda = 0, kappa = 0;
  BlockValue m;
  double p_c = 0;  // of the first row, at rest
};
// None: p_c is not determined for two rows.
std::optional<CamClay> cam_clay_of(const std::vector<CapRow>& rows);

// code_aster: DEFI_MATERIAU with CAM_CLAY, for the first row with p_c. Empty: no slope is defined.
std::string code_aster_block(const std::string& name, const std::vector<CapRow>& rows);

// LS-DYNA: *MAT_GEOLOGIC_CAP_MODEL (MAT_025), for the first row with p_b, with hardening over all. Its failure line is that of
// Drucker-Prager: ALPHA = d/sqrt(3), THETA = tan(beta)/(3 sqrt(3)), GAMMA = BETA = 0; R = 3 sqrt(3) times the R of Abaqus,
// since its abscissa is 3 p and its ordinate q/sqrt(3). Hardening eps_v = W (1 - exp(-D (X - X0))) with X = 3 p_b, W the
// compaction left to full density, and D by least squares. Empty: fewer than two rows with p_b.
std::string ls_dyna_block(const std::string& name, const std::vector<CapRow>& rows);

// Reads back what abaqus_block wrote, as a user of the block would: rows of density, moduli and cap. Throws where a parameter
// is not determined.
std::vector<CapRow> read_abaqus_block(const std::string& text);

}  // namespace pulvis

// Fitted caps as input blocks for continuum codes. Units: Pa; densities are relative.
#pragma once

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cli/campaigns/probe/cap_models.hpp"

namespace pulvis {

inline constexpr double degrees_in_radian = 180 / std::numbers::pi;

// One density of a material: means over its seeds.
struct CapRow {
  double density = 0;         // -
  double youngs_modulus = 0;  // Pa
  double poissons_ratio = 0;
  double d = 0;     // Pa, cohesion in the p-q plane
  double beta = 0;  // rad
  double r = 0;     // -, R
  double p_b = 0;   // Pa
  double m = 0;     // -, slope of the critical state line of modified Cam-Clay
  double p_c = 0;   // Pa, its preconsolidation pressure
  // Parameters of the cap and of Cam-Clay that the points do not determine, with their ranges; empty: none.
  std::string open_cap = {}, open_clay = {};
};

// Abaqus: *ELASTIC and *CAP PLASTICITY against the relative density as field variable 1, *CAP HARDENING from p_b against the
// volumetric plastic strain ln(density / first density). Rows in order of increasing density.
std::string abaqus_block(const std::string& name, const std::vector<CapRow>& rows);

// The compression and swelling slopes of Cam-Clay, from the void ratio e = (1 - density)/density: lambda = -de/d ln(p_c) over
// all rows by least squares, kappa = (1 + e) p/K at p_c/2 with the bulk modulus of the middle row.
struct CamClay {
  double porosity = 0, lambda = 0, kappa = 0, m = 0, p_c = 0;  // of the first row, at rest
};
CamClay cam_clay_of(const std::vector<CapRow>& rows);

// code_aster: DEFI_MATERIAU with CAM_CLAY, for the first row. Fewer than two rows: empty, since no slope is defined.
std::string code_aster_block(const std::string& name, const std::vector<CapRow>& rows);

// Reads back what abaqus_block wrote, as a user of the block would: rows of density, moduli and cap.
std::vector<CapRow> read_abaqus_block(const std::string& text);

}  // namespace pulvis

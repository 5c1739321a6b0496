#include "cli/campaigns/probe/keyword_blocks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

double void_ratio(double density) { return (1 - density) / density; }

std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream fields(line);
  for (std::string field; std::getline(fields, field, ',');)
    numbers.push_back(field.find_first_not_of(' ') == std::string::npos ? 0 : std::stod(field));
  return numbers;
}

// Comments of a block, in its language.
std::string open_lines(const std::vector<CapRow>& rows, std::string CapRow::*open,
                       const char* mark) {
  std::string text;
  for (const CapRow& row : rows)
    if (!(row.*open).empty())
      text += fmt::format(
          "{0} WARNING: at density {1:.4f} the yield points do not determine {2}:\n{0} values in "
          "these ranges fit as well.\n",
          mark, row.density, row.*open);
  return text;
}

}  // namespace

std::string abaqus_block(const std::string& name, const std::vector<CapRow>& rows) {
  std::string text = fmt::format(
      "** {}: modified Drucker-Prager/Cap, fitted to yield points of particles by Pulvis.\n"
      "** Units: Pa. Field variable 1 is the relative density; set it by *INITIAL CONDITIONS, "
      "TYPE=FIELD\n** and update it in USDFLD as density * exp(-volume strain).\n"
      "*MATERIAL, NAME={}\n*ELASTIC, DEPENDENCIES=1\n",
      name, name);
  for (const CapRow& row : rows)
    text += fmt::format("{:.6e}, {:.6f}, , {:.6f}\n", row.youngs_modulus, row.poissons_ratio,
                        row.density);
  text += open_lines(rows, &CapRow::open_cap, "**");
  text +=
      "** d, beta [deg], R, initial volumetric plastic strain, alpha, K, temperature, density\n"
      "*CAP PLASTICITY, DEPENDENCIES=1\n";
  for (const CapRow& row : rows)
    text += fmt::format("{:.6e}, {:.6f}, {:.6f}, 0., {:g}, 1., , {:.6f}\n", row.d,
                        row.beta * degrees_in_radian, row.r, cap_transition, row.density);
  text +=
      "** hydrostatic yield pressure p_b, volumetric plastic strain since the first row\n"
      "*CAP HARDENING\n";
  for (const CapRow& row : rows)
    text +=
        fmt::format("{:.6e}, {:.6f}\n", row.p_b, portable::log(row.density / rows.front().density));
  return text;
}

CamClay cam_clay_of(const std::vector<CapRow>& rows) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, m = 0;
  for (const CapRow& row : rows) {
    const double pressure = portable::log(row.p_c), e = void_ratio(row.density);
    n += 1, x += pressure, y += e, xx += pressure * pressure, xy += pressure * e, m += row.m;
  }
  const CapRow &first = rows.front(), &middle = rows[rows.size() / 2];
  const double bulk = middle.youngs_modulus / (3 * (1 - 2 * middle.poissons_ratio));
  return {1 - first.density, -(n * xy - x * y) / (n * xx - x * x),
          0.5 * middle.p_c / (bulk * middle.density), m / n, first.p_c};
}

std::string code_aster_block(const std::string& name, const std::vector<CapRow>& rows) {
  if (rows.size() < 2) return "";
  const CamClay clay = cam_clay_of(rows);
  const CapRow& first = rows.front();
  return fmt::format(
      "# {}: modified Cam-Clay, fitted to yield points of particles by Pulvis. Units: Pa.\n"
      "# Relative density {:.4f} at the start; PRES_CRIT is half of the preconsolidation "
      "pressure.\n"
      "{}{} = DEFI_MATERIAU(\n"
      "    ELAS=_F(E={:.6e}, NU={:.6f}),\n"
      "    CAM_CLAY=_F(MU={:.6e}, PORO={:.6f}, LAMBDA={:.6f}, KAPA={:.6e}, M={:.6f}, "
      "PRES_CRIT={:.6e}))\n",
      name, first.density, open_lines(rows, &CapRow::open_clay, "#"), name, first.youngs_modulus,
      first.poissons_ratio, first.youngs_modulus / (2 * (1 + first.poissons_ratio)), clay.porosity,
      clay.lambda, clay.kappa, clay.m, 0.5 * clay.p_c);
}

std::vector<CapRow> read_abaqus_block(const std::string& text) {
  std::vector<CapRow> rows;
  std::istringstream lines(text);
  std::string keyword;
  std::size_t at = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("**") || line.empty()) continue;
    if (line.starts_with("*")) {
      keyword = line.substr(0, line.find(','));
      at = 0;
      continue;
    }
    const std::vector<double> values = numbers_of(line);
    if (at == rows.size()) rows.emplace_back();
    CapRow& row = rows[at++];
    if (keyword == "*ELASTIC") {
      row.youngs_modulus = values.at(0), row.poissons_ratio = values.at(1);
      row.density = values.at(3);
    } else if (keyword == "*CAP PLASTICITY") {
      row.d = values.at(0), row.beta = values.at(1) / degrees_in_radian, row.r = values.at(2);
    } else if (keyword == "*CAP HARDENING") {
      row.p_b = values.at(0);
    } else {
      throw std::runtime_error("unknown keyword " + keyword);
    }
  }
  return rows;
}

}  // namespace pulvis

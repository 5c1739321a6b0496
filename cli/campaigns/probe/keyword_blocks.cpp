#include "cli/campaigns/probe/keyword_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
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
  for (std::string field; std::getline(fields, field, ',');) {
    if (field.find('<') != std::string::npos) throw std::runtime_error("not determined:" + field);
    numbers.push_back(field.find_first_not_of(' ') == std::string::npos ? 0 : std::stod(field));
  }
  return numbers;
}

// A number, or the range in its place, which no program reads as one.
std::string number_or_range(const BlockValue& value, double factor, const char* format) {
  if (!value.value) return fmt::format("<{}>", value.range);
  return fmt::format(fmt::runtime(format), *value.value * factor);
}

// A name that every code reads as one word: that of a path with a powder has a comma.
std::string word_of(std::string name) {
  for (char& c : name)
    if ((c < 'a' || c > 'z') && (c < 'A' || c > 'Z') && (c < '0' || c > '9')) c = '_';
  return name;
}

bool is_open(const CapRow& row) {
  const auto unknown = [](const BlockValue& of) { return !of.value && !of.range.empty(); };
  return unknown(row.d) || unknown(row.beta) || unknown(row.r) || unknown(row.p_b);
}

// A comment in the language of the block.
std::string warning_of_open(const char* mark) {
  return fmt::format(
      "{0} The yield points do not determine the parameters in angle brackets: all values between "
      "these\n"
      "{0} bounds fit as well. Put in one of your own, e.g. from an experiment.\n",
      mark);
}

bool has_p_c(const CapRow& row) { return row.p_c.value.has_value(); }
bool has_p_b(const CapRow& row) { return row.p_b.value.has_value(); }

double bulk_of(const CapRow& row) {
  return row.youngs_modulus / (3 * (1 - 2 * row.poissons_ratio));
}
double shear_of(const CapRow& row) { return row.youngs_modulus / (2 * (1 + row.poissons_ratio)); }

}  // namespace

std::string abaqus_block(const std::string& name, const std::vector<CapRow>& rows) {
  std::string text = fmt::format(
      "** {}: modified Drucker-Prager/Cap, fitted to yield points of particles by Pulvis.\n"
      "** Units: Pa. Field variable 1 is the relative density; set it by *INITIAL CONDITIONS, "
      "TYPE=FIELD\n** and update it in USDFLD as density * exp(-volume strain).\n"
      "*MATERIAL, NAME={}\n*ELASTIC, DEPENDENCIES=1\n",
      name, word_of(name));
  for (const CapRow& row : rows)
    text += fmt::format("{:.6e}, {:.6f}, , {:.6f}\n", row.youngs_modulus, row.poissons_ratio,
                        row.density);
  if (std::ranges::any_of(rows, is_open)) text += warning_of_open("**");
  text +=
      "** d, beta [deg], R, initial volumetric plastic strain, alpha, K, temperature, density\n"
      "*CAP PLASTICITY, DEPENDENCIES=1\n";
  for (const CapRow& row : rows)
    text += fmt::format("{}, {}, {}, 0., {:g}, 1., , {:.6f}\n", number_or_range(row.d, 1, "{:.6e}"),
                        number_or_range(row.beta, degrees_in_radian, "{:.6f}"),
                        number_or_range(row.r, 1, "{:.6f}"), cap_transition, row.density);
  text +=
      "** hydrostatic yield pressure p_b, volumetric plastic strain since the first row\n"
      "*CAP HARDENING\n";
  for (const CapRow& row : rows)
    text += fmt::format("{}, {:.6f}\n", number_or_range(row.p_b, 1, "{:.6e}"),
                        portable::log(row.density / rows.front().density));
  return text;
}

std::optional<CamClay> cam_clay_of(const std::vector<CapRow>& rows) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, m = 0, slopes = 0;
  const CapRow* first = nullptr;
  for (const CapRow& row : rows) {
    if (row.m.value) m += *row.m.value, slopes += 1;
    if (!row.p_c.value) continue;
    if (first == nullptr) first = &row;
    const double pressure = portable::log(*row.p_c.value), e = void_ratio(row.density);
    n += 1, x += pressure, y += e, xx += pressure * pressure, xy += pressure * e;
  }
  if (n < 2) return std::nullopt;
  const CapRow& middle = rows[rows.size() / 2];
  CamClay clay;
  clay.porosity = 1 - first->density;
  clay.lambda = -(n * xy - x * y) / (n * xx - x * x);
  clay.p_c = *first->p_c.value;
  const double pressure = middle.p_c.value.value_or(clay.p_c);
  clay.kappa = 0.5 * pressure / (bulk_of(middle) * middle.density);
  clay.m = slopes > 0 ? BlockValue(m / slopes) : rows.front().m;
  return clay;
}

std::string code_aster_block(const std::string& name, const std::vector<CapRow>& rows) {
  const std::optional<CamClay> clay = cam_clay_of(rows);
  if (!clay) return "";
  const CapRow& first = *std::ranges::find_if(rows, &has_p_c);
  return fmt::format(
      "# {}: modified Cam-Clay, fitted to yield points of particles by Pulvis. Units: Pa.\n"
      "# Relative density {:.4f} at the start; PRES_CRIT is half of the preconsolidation "
      "pressure.\n"
      "{}{} = DEFI_MATERIAU(\n"
      "    ELAS=_F(E={:.6e}, NU={:.6f}),\n"
      "    CAM_CLAY=_F(MU={:.6e}, PORO={:.6f}, LAMBDA={:.6f}, KAPA={:.6e}, M={}, "
      "PRES_CRIT={:.6e}))\n",
      name, 1 - clay->porosity, clay->m.value ? "" : warning_of_open("#"), word_of(name),
      first.youngs_modulus, first.poissons_ratio, shear_of(first), clay->porosity, clay->lambda,
      clay->kappa, number_or_range(clay->m, 1, "{:.6f}"), 0.5 * clay->p_c);
}

namespace {

// Hardening of LS-DYNA's cap: eps_v = W (1 - exp(-D (X - X0))), with W given.
struct Hardening {
  double w = 0, d = 0, x_0 = 0;  // -, 1/Pa, Pa
};
std::optional<Hardening> hardening_of(const std::vector<CapRow>& rows) {
  const CapRow* first = nullptr;
  Hardening law;
  double products = 0, squares = 0;
  for (const CapRow& row : rows) {
    if (!row.p_b.value) continue;
    if (first == nullptr) {
      first = &row;
      law.x_0 = 3 * *row.p_b.value;
      law.w = -portable::log(row.density);
      continue;
    }
    const double left = 1 - portable::log(row.density / first->density) / law.w;
    const double pressure = 3 * *row.p_b.value - law.x_0;
    if (left <= 0) continue;
    products += -portable::log(left) * pressure, squares += pressure * pressure;
  }
  if (squares == 0 || law.w <= 0) return std::nullopt;
  law.d = products / squares;
  return law;
}

}  // namespace

std::string ls_dyna_block(const std::string& name, const std::vector<CapRow>& rows) {
  const std::optional<Hardening> law = hardening_of(rows);
  if (!law) return "";
  const CapRow& row = *std::ranges::find_if(rows, &has_p_b);
  const double root = std::sqrt(3.0);
  BlockValue alpha = row.d, theta = row.beta, r = row.r;
  if (theta.value) theta.value = portable::tan(*theta.value) / (3 * root);
  alpha.range += ", d/sqrt(3)", theta.range += ", tan(beta)/(3 sqrt(3))",
      r.range += ", 3 sqrt(3) R";
  return fmt::format(
      "$ {}: cap model fitted to yield points of particles by Pulvis. Units: Pa, kg, m, s.\n"
      "$ Relative density {:.4f} at the start; comma-separated free format.\n{}"
      "*MAT_GEOLOGIC_CAP_MODEL_TITLE\n{}\n"
      "$ MID, RO, BULK, G, ALPHA, THETA, GAMMA, BETA\n"
      "1, {}, {:.6e}, {:.6e}, {}, {}, 0., 0.\n"
      "$ R, D, W, X0, C, N\n{}, {:.6e}, {:.6f}, {:.6e}, 0., 0.\n"
      "$ PLOT, FTYPE, VEC, TOFF\n0., 2., 0., 0.\n",
      name, row.density, is_open(row) ? warning_of_open("$") : "", word_of(name),
      row.solid_density > 0 ? fmt::format("{:.6e}", row.density * row.solid_density)
                            : "<bulk density>",
      bulk_of(row), shear_of(row), number_or_range(alpha, 1 / root, "{:.6e}"),
      number_or_range(theta, 1, "{:.6f}"), number_or_range(r, 3 * root, "{:.6f}"), law->d, law->w,
      law->x_0);
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

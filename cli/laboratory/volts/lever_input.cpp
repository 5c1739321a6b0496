#include "cli/laboratory/volts/lever_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/files/input_file.hpp"
#include "engine/portable_math.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis::volts {
namespace {

constexpr std::size_t largest_summary = 16U << 20U;  // bytes

[[noreturn]] void refuse_summary(const std::filesystem::path& file, const std::string& what) {
  throw SceneError({{file.string(), 1, 1, "", "lever.calibration",
                     what + ", allowed: summary.json of a run of an AFM scene"}});
}

nlohmann::json summary_of(const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(text_of_input(file, largest_summary));
  } catch (const UnfitInput& unfit) {
    refuse_summary(file, unfit.what());
  } catch (const nlohmann::json::parse_error&) {
    refuse_summary(file, "is not JSON");
  }
}

}  // namespace

Lever lever_of(const LeverSpec& spec, const std::filesystem::path& folder) {
  if (spec.calibration.empty()) {
    const double c = portable::cos(spec.tilt.value_or(0));
    return {spec.k_n.value() / (c * c), spec.k_l, spec.arm, spec.twist_share.value_or(1)};
  }
  const std::filesystem::path file = folder / spec.calibration;
  const nlohmann::json summary = summary_of(file);
  if (!summary.is_object() || !summary.contains("calibration") ||
      !summary["calibration"].is_object())
    refuse_summary(file, "holds no calibration of a lever");
  const nlohmann::json& calibration = summary["calibration"];
  const auto number = [&](const char* name) {
    const bool is_there = calibration.contains(name) && calibration[name].is_number();
    const double value = is_there ? calibration[name].get<double>() : 0.0;
    if (!(value > 0) || !std::isfinite(value))
      refuse_summary(file, fmt::format("has no calibration/{} above zero", name));
    return value;
  };
  return {number("k_n"), number("k_l"), number("arm"), number("share_twist")};
}

}  // namespace pulvis::volts

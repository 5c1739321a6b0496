// Output files and messages of the conversion from an AFM's volts to friction.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/laboratory/lab_settings.hpp"
#include "cli/laboratory/volts/volts_reduction.hpp"

namespace pulvis {

struct VoltsReduction {
  lab::LoadedSettings loaded;
  volts::Reduced reduced;
};

// From the files that the settings name; throws SceneError.
VoltsReduction volts_reduction(const lab::LoadedSettings& loaded);

std::vector<std::string> volts_files();  // that are written

// Content of summary.json, all in SI units.
nlohmann::ordered_json volts_json(const VoltsReduction& reduction);

void write_volts(const std::filesystem::path& folder, const VoltsReduction& reduction);

std::string volts_text(const VoltsReduction& reduction);

}  // namespace pulvis

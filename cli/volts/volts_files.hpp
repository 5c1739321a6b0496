// What the way from an AFM's volts to friction leaves in its folder and prints.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/records/lab_settings.hpp"
#include "scenes/volts/volts_reduction.hpp"

namespace pulvis {

struct VoltsReduction {
  lab::LoadedSettings loaded;
  volts::Reduced reduced;
};

// Of what the settings name; throws SceneError.
VoltsReduction volts_reduction(const lab::LoadedSettings& loaded);

std::vector<std::string> volts_files();  // that are written

// What summary.json holds, all in SI units.
nlohmann::ordered_json volts_json(const VoltsReduction& reduction);

void write_volts(const std::filesystem::path& folder, const VoltsReduction& reduction);

std::string volts_text(const VoltsReduction& reduction);

}  // namespace pulvis

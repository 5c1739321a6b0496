// pulvis run, check and plan for scenes of the family "afm".
#pragma once

#include <filesystem>

#include "cli/exit_code.hpp"
#include "scenes/read.hpp"

namespace pulvis {

ExitCode run_afm(const LoadedScene& loaded, const std::filesystem::path& folder, int threads,
                 bool overwrite);
ExitCode check_afm_scene(const Scene& scene);
ExitCode plan_afm(const Scene& scene, bool dot);

}  // namespace pulvis

// pulvis run, resume and plan for scenes of the family "afm".
#pragma once

#include <filesystem>

#include "cli/session/run.hpp"
#include "scenes/read.hpp"

namespace pulvis {

ExitCode run_afm(const LoadedScene& loaded, const RunOptions& options,
                 const std::filesystem::path& folder, int threads);
ExitCode resume_afm(const LoadedScene& loaded, const RunOptions& options,
                    const Checkpoint& checkpoint, int threads);
ExitCode plan_afm(const Scene& scene, bool dot);

}  // namespace pulvis

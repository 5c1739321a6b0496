// Compression in an instrumented die: wall friction and stress ratio against density, compared with simulations.
#pragma once

#include "cli/laboratory/output/lab_output.hpp"

namespace pulvis {

LabOutput die_output(const lab::LoadedSettings& loaded,
                     const std::vector<std::filesystem::path>& simulations);

}  // namespace pulvis

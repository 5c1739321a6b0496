// Compressions in an instrumented die: wall friction and stress ratio as functions of the density, simulations beside.
#pragma once

#include "cli/lab/lab_output.hpp"

namespace pulvis {

LabOutput die_output(const lab::LoadedSettings& loaded,
                     const std::vector<std::filesystem::path>& simulations);

}  // namespace pulvis

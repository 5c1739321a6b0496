// Compression curves of a press: reduced, fitted, and compared with simulations.
#pragma once

#include "cli/laboratory/output/lab_output.hpp"

namespace pulvis {

LabOutput compression_output(const lab::LoadedSettings& loaded,
                             const std::vector<std::filesystem::path>& simulations);

}  // namespace pulvis

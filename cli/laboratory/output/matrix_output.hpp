// Sliding-plate tests over a matrix of conditions: means with their intervals, and main effects of the factors.
#pragma once

#include "cli/laboratory/output/lab_output.hpp"
#include "cli/laboratory/output/reduction_files.hpp"

namespace pulvis {

// For runs that all state their condition.
LabOutput matrix_output(const Reduction& all);

}  // namespace pulvis

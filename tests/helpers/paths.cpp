#include "tests/helpers/paths.hpp"

namespace pulvis::paths {

std::string source_dir() { return PULVIS_SOURCE_DIR; }
std::string program() { return PULVIS_PROGRAM; }
std::string libraries() { return PULVIS_LIBRARIES; }

}  // namespace pulvis::paths

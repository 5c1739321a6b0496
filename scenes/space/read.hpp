// Reads scenes in three dimensions from their tree; the other steps are in scenes/read.cpp.
#pragma once

#include <filesystem>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// `origins`: source locations of all keys.
Scene read_tree(const document::Table& root, const std::filesystem::path& file, Problems& problems,
                schema::Origins& origins);

}  // namespace pulvis::space

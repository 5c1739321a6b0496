// Scenes in three dimensions read from their tree; the steps around it are those of two (scenes/read.cpp).
#pragma once

#include <filesystem>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// `origins`: where every key of it is written.
Scene read_tree(const document::Table& root, const std::filesystem::path& file, Problems& problems,
                schema::Origins& origins);

}  // namespace pulvis::space

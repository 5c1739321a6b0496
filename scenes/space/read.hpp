// Scenes in three dimensions read from their tree; the steps around it are those of two (scenes/read.cpp).
#pragma once

#include <filesystem>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Refuses keys, tables and words that two dimensions have and three have not, and a `dimension` that comes from an
// expression.
void refuse_keys_of_the_plane(const document::Table& root, Problems& problems);

// Writes the meshes' counts that `accuracy` stands for.
void fill_meshes(document::Table& root, Problems& problems);

// `origins`: where every key of it is written.
Scene read_tree(const document::Table& root, const std::filesystem::path& file, Problems& problems,
                schema::Origins& origins);

}  // namespace pulvis::space

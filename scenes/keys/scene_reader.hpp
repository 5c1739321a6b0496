// The tables of a scene as plain values.
#pragma once

#include <filesystem>

#include "scenes/keys/tables.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {

// `root`: with all defaults. `origins`: the source locations of everything that has been read.
Scene read_tables(const document::Table& root, const std::filesystem::path& file,
                  Problems& problems, schema::Origins& origins);

}  // namespace pulvis

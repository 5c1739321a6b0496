// `extends = "other.toml"`: a scene that states only its differences from another file.
//
// Tables      are merged key by key: values in the extending file replace those in the base file
// Repeated    an element with a name replaces keys of the element of that name, or is appended;
//             moves and servos are matched by their tool. Elements without either ([[body]], [[packing]],
//             [[friction]], [[action]], [[expect]]): if any are given, they replace all of the base file's,
//             unless all lack the required selector (`kind`): then they change those at their positions
// `remove`    removes keys, tables and elements from the base file before merging
// Files       paths are relative to the folder of the file that names them, as everywhere
//
// The resulting tree has neither key. Every entry keeps the file and line that set it.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

// The complete tree of a file's text; the base files are registered with `problems`. Errors are
// thrown as SceneError.
document::Table whole_tree(const std::string& text, const std::filesystem::path& file,
                           const schema::Language& language, Problems& problems);

}  // namespace pulvis

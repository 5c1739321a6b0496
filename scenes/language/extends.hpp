// `extends = "other.toml"`: a scene that states only what differs from another file.
//
// Tables      are merged key by key: what the extending file gives replaces what the other one says
// Repeated    an element with a name replaces keys of the element of that name, or is added after the others;
//             a move and a servo are matched by their tool. Elements without either ([[body]], [[packing]],
//             [[friction]], [[action]], [[expect]]): where some are given, they replace all of the other's
// `remove`    takes keys, tables and elements out of what is extended, before anything is merged
// Files       are named from the folder of the file that names them, as everywhere
//
// The tree that comes out has neither key. Every entry keeps the file and line that said it.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

// The tree of a file's text, whole; the files that it extends are made known to `problems`. What is wrong is
// thrown as SceneError.
document::Table whole_tree(const std::string& text, const std::filesystem::path& file,
                           const schema::Language& language, Problems& problems);

}  // namespace pulvis

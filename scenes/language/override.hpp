// Overrides of a scene's keys from the command line: `--set key.path=value`.
//
// The path consists of tables and keys separated by dots. An element of a repeated table is selected
// by its position or its name (a move: by its tool); a name with a dot is quoted:
//   time.safety=0.5          material[0].yield_stress=100 MPa      stage.press.duration=2 ms
//   title=softer             material.316L.yield_stress=100 MPa    stage.press.move.top.ramp=0.2
//   tool.top.point=["0 m", "101 mm"]                               material."a.b".density=1 g/cm^3
// A value that is not TOML is taken as a string, so quotes are rarely needed.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis {

std::string key_of(
    const std::string& override_text);  // "contact.friction" of "contact.friction=0.1"

// Two overrides of one key, by their positions in the list, whatever way their paths name it.
struct ReplacedOverride {
  std::size_t earlier, later;
};

// Later overrides win; the ones that they replace are returned. Errors in an override are added to `problems`.
std::vector<ReplacedOverride> apply_overrides(document::Table& root,
                                              const std::vector<std::string>& overrides,
                                              Problems& problems);

// Removes the key, table or element at `path`; `where` is the place that requests it. A repeated table whose
// last element is removed is removed, too.
void remove_path(document::Table& root, const std::string& path, const document::Origin& where,
                 Problems& problems);

}  // namespace pulvis

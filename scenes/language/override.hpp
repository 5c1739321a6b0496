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

// Later overrides win. Errors in an override are added to `problems`.
void apply_overrides(document::Table& root, const std::vector<std::string>& overrides,
                     Problems& problems);

// Removes the key, table or element at `path`; `where` is the place that requests it. A repeated table whose
// last element is removed is removed, too.
void remove_path(document::Table& root, const std::string& path, const document::Origin& where,
                 Problems& problems);

}  // namespace pulvis

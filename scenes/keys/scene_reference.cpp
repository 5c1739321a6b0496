#include "scenes/keys/scene_reference.hpp"
#include "scenes/language/describe_schema.hpp"

#include "scenes/keys/tables.hpp"
#include "scenes/language/describe.hpp"

namespace pulvis {
namespace {

constexpr const char* introduction = R"(# The scene file

<!-- Generated from the declarations in scenes/keys: change those, not this file. -->

A scene is a TOML file that declares one experiment. It is checked before anything runs: unknown
keys, wrong units, values that are impossible or have no effect, and references to names that do not
exist are refused as `file:line:col: key: what is wrong, allowed: what is allowed`.

**Quantities** are strings of a number and a unit: `"10 mm"`, `"200 GPa"`, `"0.3 N/um^2"`,
`"45 deg"`. Any unit of the right dimension will do; a bare number is refused where a unit is needed.
Ranges below are in SI units. **Numbers** without a dimension are written bare: `0.3`.

**Files that extend another**: `extends = "other.toml"` takes everything from that file, and this one
says only what differs. `pulvis check --print` shows the whole.

- A table is merged key by key. A value, an array too, replaces the other file's.
- Of a repeated table, an element with a `name` changes the element of that name, or comes after the
  others; `[[stage.move]]` and `[[stage.servo]]` are matched by their `tool`. The others have nothing to
  be matched by: `[[body]]`, `[[packing]]`, `[[friction]]`, `[[action]]` and `[[expect]]`, where there are
  any, replace all of the other file's.
- `remove = ["tool.left", "particle.disc.mesh"]` takes out what is not wanted, before anything is merged.
- The other file may extend one itself, and need not be a whole scene. Files are named from the folder of
  the file that names them. What is wrong is told at the file and line that said it.

```
extends = "../compaction/regular-100.toml"
title = "The same, rougher and faster"

[[stage]]
name = "press"
duration = "2 ms"

[contact]
friction = 0.3
```

**Overrides** on the command line change one key: `--set key.path=value`. An element of a repeated
table is chosen by position or by name (a move: by its tool); a name with a dot is quoted. A value
that is not TOML is taken as a string.

```
--set time.safety=0.5
--set "material[0].yield_stress=100 MPa"     --set "material.316L.yield_stress=100 MPa"
--set "stage.press.duration=2 ms"            --set stage.press.move.top.ramp=0.2
--set 'tool.top.point=["0 m", "101 mm"]'
```
)";

}  // namespace

std::string scene_reference() { return reference_of(introduction, schema::scene_language()); }

std::string scene_json_schema() {
  return json_schema_of("Pulvis scene", "scenes/keys", schema::scene_language(), {"material"});
}

}  // namespace pulvis

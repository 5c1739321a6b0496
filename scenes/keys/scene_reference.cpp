#include "scenes/keys/scene_reference.hpp"
#include "scenes/language/describe_schema.hpp"

#include "scenes/keys/tables.hpp"
#include "scenes/language/describe.hpp"

namespace pulvis {
namespace {

constexpr const char* introduction = R"md(# The scene file

<!-- Generated from the declarations in scenes/keys: change those, not this file. -->

A scene is a TOML file that declares one experiment. It is checked before anything runs: unknown
keys, wrong units, values that are impossible or have no effect, and references to names that do not
exist are refused as `file:line:col: key: what is wrong, allowed: what is allowed`.

**Quantities** are strings of a number and a unit: `"10 mm"`, `"200 GPa"`, `"0.3 N/um^2"`,
`"45 deg"`. Any unit of the right dimension will do; a bare number is refused where a unit is needed.
Ranges below are in SI units. **Numbers** without a dimension are written bare: `0.3`.

**Variables and expressions**: `[let]` names numbers and quantities, and wherever a number or a quantity
stands in the scene, an expression in quotes may stand instead.

```toml
[let]
D = "24 mm"
n = 10
gap = "D/200"

[[tool]]
point = ["n*D", "0 mm"]                 # 240 mm

[[packing]]
rows = "n"
corner = ["gap", "2*gap + 0.1 mm"]
```

- Operators are `+ - * / ^` and brackets; functions `sqrt`, `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `exp`,
  `log` (natural), `abs`, `min`, `max`, `floor`, `ceil` and `round`, and `pi`.
- A unit stands right behind its number: `0.1 mm`, `3 N/um^2`; blanks stand around `+` and `-`. Everywhere else a
  name is a variable, so `2*D` is twice `D`, and `D/(1 mm)` its number of millimetres.
- Dimensions are checked: a length plus a force is refused, as is a pressure where a length is wanted. Angles are no
  plain numbers: `R*(phi/1 rad)` is an arc.
- Where a whole number is wanted, the value must be one: `"floor(W/D)"`.
- Names, paths and words are never expressions.
- `--set "let.D=12 mm"` changes a variable, and so do studies: `let.D = ["12 mm", "24 mm"]` in `[grid]`. A file that
  extends another changes variables in its own `[let]`. The scene that a run keeps has the values.

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
)md";

}  // namespace

std::string scene_reference() { return reference_of(introduction, schema::scene_language()); }

std::string scene_json_schema() {
  return json_schema_of("Pulvis scene", "scenes/keys", schema::scene_language(), {"material"});
}

}  // namespace pulvis

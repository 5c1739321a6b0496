#include "scenes/keys/scene_reference.hpp"
#include "scenes/language/describe_schema.hpp"

#include "scenes/keys/tables.hpp"
#include "scenes/language/describe.hpp"

namespace pulvis {
namespace {

constexpr const char* introduction = R"md(# The scene file

<!-- Generated from the declarations in scenes/keys: change those, not this file. -->

A scene is a TOML file that defines one experiment. It is checked before anything runs: unknown
keys, wrong units, values that are impossible or have no effect, and references to undefined names
are refused with the message `file:line:col: key: what is wrong, allowed: what is allowed`.

**Quantities** are strings of a number and a unit: `"10 mm"`, `"200 GPa"`, `"0.3 N/um^2"`,
`"45 deg"`. Any unit of the right dimension is accepted; a number without a unit is refused where a
unit is required. Ranges below are in SI units. Dimensionless **numbers** are written without quotes: `0.3`.

**Dimensions**: a scene has two dimensions (plane strain, a slice of the given thickness), or three with `dimension = 3` at
its top. The column *in* says where a key exists; a key that means something else in three dimensions has two rows. A
vector has as many components as the scene has dimensions: `["0 mm", "1 mm"]` or `["0 mm", "0 mm", "1 mm"]`; a punch
usually moves along the last axis. A key or word of the other dimension is refused with an explanation.
Levers (`family = "afm"`) have no `dimension`.

**Variables and expressions**: `[let]` defines named numbers and quantities. Wherever the scene expects a
number or a quantity, an expression in quotes may be used.

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

- Operators are `+ - * / ^` and parentheses. Functions are `sqrt`, `sin`, `cos`, `tan`, `asin`, `acos`, `atan`,
  `exp`, `log` (natural), `abs`, `min`, `max`, `floor`, `ceil` and `round`. `pi` is predefined.
- A unit directly follows its number: `0.1 mm`, `3 N/um^2`. Put spaces around `+` and `-`. Everywhere else
  a name is a variable, so `2*D` is twice `D`, and `D/(1 mm)` is its value in millimetres.
- Dimensions are checked: adding a length and a force is refused, as is a pressure where a length is expected. Angles
  are not dimensionless: `R*(phi/1 rad)` is an arc length.
- Where a whole number is expected, the expression must give one: `"floor(W/D)"`.
- Names, paths and choices are never expressions.
- `--set "let.D=12 mm"` changes a variable, and so do studies: `let.D = ["12 mm", "24 mm"]` in `[grid]`. A file that
  extends another changes variables in its own `[let]`. The scene saved with a run contains the values.

**Extending another file**: `extends = "other.toml"` takes everything from that file; this file contains
only the differences. `pulvis check --print` shows the merged scene.

- Tables are merged key by key. A value, including an array, replaces that of the other file.
- In a repeated table, an element with a `name` changes the element of that name or is appended;
  `[[stage.move]]` and `[[stage.servo]]` are matched by their `tool`. `[[body]]`, `[[packing]]`,
  `[[friction]]`, `[[action]]` and `[[expect]]` have no name: if present, they replace all those of the
  other file.
- A `[[packing]]` or `[[action]]` without `kind` changes single keys of that at the same position of the other
  file: as many are given as there are, empty where nothing changes.
- `remove = ["tool.left", "particle.disc.mesh"]` deletes items of the other file before merging.
- The other file may itself extend a file, and need not be a complete scene. Paths are relative to the folder
  of the file that contains them. Errors are reported at the file and line where they occur.

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
table is selected by position or by name (a move by its tool); a name that contains a dot is quoted. A
value that is not valid TOML is read as a string.

```
--set time.safety=0.5
--set "material[0].yield_stress=100 MPa"     --set "material.316L.yield_stress=100 MPa"
--set "stage.press.duration=2 ms"            --set stage.press.move.top.ramp=0.2
--set 'tool.top.point=["0 m", "101 mm"]'
```

**A complete scene** in three dimensions, a ball between two plates ([tutorial-3d.md](tutorial-3d.md) leads on from here):

```toml
family = "compaction"
dimension = 3

[[material]]
name = "316L"
library = "316L"

[[particle]]
name = "ball"
material = "316L"
shape = "sphere"
diameter = "1 mm"

[[body]]
particle = "ball"
position = ["0 mm", "0 mm", "0.5 mm"]

[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]

[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", "1 mm"]
normal = [0, 0, -1]

[[stage]]
name = "press"
kind = "compact"
duration = "50 us"

[[stage.move]]
tool = "top"
displacement = ["0 mm", "0 mm", "-0.1 mm"]
```
)md";

}  // namespace

std::string scene_reference() { return reference_of(introduction, schema::scene_language()); }

std::string scene_json_schema() {
  return json_schema_of("Pulvis scene", "scenes/keys", schema::scene_language(), {"material"});
}

}  // namespace pulvis

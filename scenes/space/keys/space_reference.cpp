#include "scenes/space/keys/space_reference.hpp"

#include "scenes/language/describe.hpp"
#include "scenes/language/describe_schema.hpp"
#include "scenes/space/keys/tables.hpp"

namespace pulvis {
namespace {

constexpr const char* introduction_in_space = R"md(# The scene file in three dimensions

<!-- Generated from the declarations in scenes/space/keys and scenes/keys: change those, not this file. -->

This language applies to scenes with `dimension = 3` at the top. Quantities, variables and expressions, extending
another file, and overrides work as in two dimensions: [scene](scene.md).

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

Vectors have three components, x, y and z; a punch usually moves along z. Forces act on whole particles: there is no
thickness. Features available only in two dimensions, such as grains, periodic cells and constraints, are refused
with an explanation.
)md";

}  // namespace

std::string space_scene_reference() {
  return reference_of(introduction_in_space, space::scene_language());
}

std::string space_scene_json_schema() {
  return json_schema_of("Pulvis scene in three dimensions", "scenes/space/keys and scenes/keys",
                        space::scene_language(), {"material"});
}

}  // namespace pulvis

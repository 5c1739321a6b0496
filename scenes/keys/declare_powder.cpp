// Declarations of the top level of a scene.
#include "scenes/keys/declare.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::schema {

const TableDeclaration<Scene>& top_level() {
  static const TableDeclaration<Scene> declaration{
      {"", false, "family", "Keys at the top level of the file.", every_family},
      {{{.name = "extends",
         .kind = Kind::scene,
         .doc = "Another file, as a path relative to the folder of this one: a scene or part "
                "of a scene. This file then contains only the differences (see above).",
         .fallback_doc = "none: the scene is complete"},
        nothing<Scene>},
       {{.name = "remove",
         .kind = Kind::texts,
         .needs = "extends",
         .doc = "Parts of the extended file to remove: paths of keys, tables and elements as "
                "for `--set`, `[\"tool.left\", \"limits\"]`."},
        nothing<Scene>},
       {{.name = "family",
         .kind = Kind::choice,
         .choices = {{"compaction", "deformable particles in a rigid die, 2D plane strain or 3D"},
                     {"afm", "a cantilever with a tip or a colloid probe, 3D, quasi-static"}},
         .required = true,
         .doc = "Kind of experiment."},
        [](Scene& scene, const Decoded& value) {
          if (value.index == 1) scene.afm = std::make_shared<AfmScene>();
        }},
       {{.name = "dimension",
         .kind = Kind::integer,
         .range = within(2, 3),
         .only_for = compaction_only,
         .doc = "Number of dimensions: 2 (plane strain) or 3, as a number, not an expression.",
         .fallback_doc = "`2`"},
        nothing<Scene>},
       {{.name = "title",
         .kind = Kind::text,
         .fallback = value_of(""),
         .doc = "Title of the report."},
        to(&Scene::title)},
       {{.name = "accuracy",
         .kind = Kind::choice,
         .choices = {{"draft", "for a quick look"},
                     {"standard", "beyond it, cost rises steeply for little gain"},
                     {"fine", "for final results"}},
         .only_for = compaction_only,
         .doc = "Mesh resolution of particles without explicit mesh sizes; expected errors: "
                "docs/accuracy.md.",
         .fallback_doc = "`\"standard\"`"},
        nothing<Scene>},
       {{.name = "thickness",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .fallback = value_of("1 mm"),
         .only_for = compaction_only,
         .doc = "Thickness of the plane-strain slice; forces refer to it.",
         .dimension = Dimension::two},
        to(&Scene::thickness)},
       {{.name = "seed",
         .kind = Kind::integer,
         .range = within(0, 1e15),
         .fallback = value_of(1),
         .only_for = compaction_only,
         .doc = "Seed of all random numbers except the `variant` of outlines; the same seed "
                "gives the same run."},
        [](Scene& scene, const Decoded& value) {
          scene.seed = static_cast<std::uint64_t>(value.integer);
        }},
       {{.name = "initial_state",
         .kind = Kind::file,
         .only_for = compaction_only,
         .doc = "State saved by another run of the same powder (`stage.keep_state`), as a path "
                "relative to the folder of the scene. The powder, with its die or periodic cell, "
                "starts from it, at time 0 and with the stages of this scene. Accumulated "
                "quantities (strain, work, energies) continue from it.",
         .fallback_doc = "the initial packing"},
        [](Scene& scene, const Decoded& value) { scene.initial_state = value.text; }}}};
  return declaration;
}

}  // namespace pulvis::schema

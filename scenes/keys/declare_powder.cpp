// Declarations of the top level of a scene.
#include "scenes/keys/declare.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::schema {

const TableDeclaration<Scene>& top_level() {
  static const TableDeclaration<Scene> declaration{
      {"", false, "family", "Keys before the first table.", every_family},
      {{{.name = "extends",
         .kind = Kind::scene,
         .doc = "Another file, from the folder of this one: a scene, or a part of one. This file "
                "says only what "
                "differs from it (above).",
         .fallback_doc = "the scene is whole"},
        nothing<Scene>},
       {{.name = "remove",
         .kind = Kind::texts,
         .needs = "extends",
         .doc = "What of the extended file is not wanted: paths of keys, tables and elements as "
                "for `--set`, "
                "`[\"tool.left\", \"limits\"]`."},
        nothing<Scene>},
       {{.name = "family",
         .kind = Kind::choice,
         .choices = {{"compaction", "deformable particles in a rigid die, 2D plane strain or 3D"},
                     {"afm", "a cantilever with a tip or a colloid probe, 3D, quasi-static"}},
         .required = true,
         .doc = "What kind of experiment this is."},
        [](Scene& scene, const Decoded& value) {
          if (value.index == 1) scene.afm = std::make_shared<AfmScene>();
        }},
       {{.name = "dimension",
         .kind = Kind::integer,
         .range = within(2, 3),
         .only_for = compaction_only,
         .doc = "2: as this page says; 3: scenes in space, which are a language of their own "
                "(docs/scene-3d.md).",
         .fallback_doc = "`2`"},
        nothing<Scene>},
       {{.name = "title",
         .kind = Kind::text,
         .fallback = value_of(""),
         .doc = "Heading of the report."},
        to(&Scene::title)},
       {{.name = "accuracy",
         .kind = Kind::choice,
         .choices = {{"draft", "a quick look"},
                     {"standard", "where more costs much and brings little"},
                     {"fine", "for results to rely on"}},
         .only_for = compaction_only,
         .doc = "How fine the meshes are that do not say it themselves; the error to expect: "
                "docs/accuracy.md.",
         .fallback_doc = "`\"standard\"`"},
        nothing<Scene>},
       {{.name = "thickness",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .fallback = value_of("1 mm"),
         .only_for = compaction_only,
         .doc = "Thickness of the plane-strain slice: forces are those on this slice."},
        to(&Scene::thickness)},
       {{.name = "seed",
         .kind = Kind::integer,
         .range = within(0, 1e15),
         .fallback = value_of(1),
         .only_for = compaction_only,
         .doc = "Seed of everything random, but for the `variant` of outlines; the same seed gives "
                "the "
                "same run."},
        [](Scene& scene, const Decoded& value) {
          scene.seed = static_cast<std::uint64_t>(value.integer);
        }},
       {{.name = "initial_state",
         .kind = Kind::file,
         .only_for = compaction_only,
         .doc = "A state that another run of the same powder has kept (`stage.keep_state`), "
                "relative to the scene's folder: the powder in its periodic cell begins with it, "
                "at time 0 and with the stages of this scene. What is drawn or counted over a run "
                "(strain, work, energies) goes on from there.",
         .fallback_doc = "the powder as it is packed"},
        [](Scene& scene, const Decoded& value) { scene.initial_state = value.text; }}}};
  return declaration;
}

}  // namespace pulvis::schema

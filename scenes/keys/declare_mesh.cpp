// Declarations of the finite elements of a particle.
#include <concepts>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

// A key of every mesh that has the member: the one chosen does, only_for sees to that.
template <class Set>
auto mesh_to(Set set) {
  return [set](ParticleSpec& particle, const Decoded& value) {
    std::visit(
        [&](auto& mesh) {
          if constexpr (std::invocable<Set, decltype(mesh), int>)
            set(mesh, static_cast<int>(value.integer));
        },
        particle.mesh);
  };
}

}  // namespace

const TableDeclaration<ParticleSpec>& mesh() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle.mesh", false, "outline", "Finite elements of one particle."},
      {{{.name = "size",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Wanted length of the edges along the outline, instead of their number and that of "
                "the rings; finer where the outline turns sharply.",
         .fallback_doc = "by `accuracy`"},
        [](ParticleSpec& spec, const Decoded& value) { spec.mesh_size = value.number; }},
       {{.name = "boundary_edges",
         .kind = Kind::integer,
         .range = within(4, 4096),
         .multiple_of = 4,
         .only_for = {"disc", "rounded_rectangle", "ring", "ellipse", "superellipse", "polygon",
                      "points", "fourier"},
         .doc = "Edges along the outline; an even core has (boundary_edges/4)^2 quads. Corners of "
                "a small radius get four edges each, which grow towards the middle of the flats.",
         .fallback_doc = "by `accuracy`; beside other sizes 40, of what is no disc or ring 48"},
        mesh_to(
            [](auto& mesh, int value) requires requires { mesh.boundary_edges; } {
              mesh.boundary_edges = value;
            })},
       {{.name = "rings",
         .kind = Kind::integer,
         .range = within(0, 1024),
         .only_for = {"disc", "rounded_rectangle", "ring", "ellipse", "superellipse", "polygon",
                      "points", "fourier"},
         .doc =
             "Rings of quads between the core and the outline, of a ring through its wall; 0: only "
             "the core, for discs of at most 20 boundary edges or with a coarse core.",
         .fallback_doc = "by `accuracy`; beside other sizes 1, of a ring 4"},
        mesh_to(
            [](auto& mesh, int value) requires requires { mesh.rings; } { mesh.rings = value; })},
       {{.name = "core",
         .kind = Kind::choice,
         .choices = {{"even", "as fine as the outline"},
                     {"coarse",
                      "one edge for three of the outline, joined by a ring of transition quads; "
                      "boundary_edges is a multiple of 12"}},
         .only_for = "disc",
         .doc = "The inside of the rings.",
         .fallback_doc = "by `accuracy`; beside other sizes `\"even\"`"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<DiscMesh>(spec.mesh).core = static_cast<DiscMesh::Core>(value.index);
        }},
       {{.name = "refinement",
         .kind = Kind::number,
         .range = within(1, 100),
         .fallback = value_of(1.0),
         .only_for = "disc",
         .doc = "How much finer the edges at top and bottom are than those at the sides."},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<DiscMesh>(spec.mesh).refinement = value.number;
        }},
       {{.name = "phase",
         .kind = Kind::phase,
         .unit = "rad",
         .range = within(-1000, 1000),
         .word = "random",
         .fallback = value_of("0 deg"),
         .only_for = {"disc", "ring"},
         .doc =
             "Turn of the mesh inside the outline; \"random\" turns each particle's by its own."},
        [](ParticleSpec& spec, const Decoded& value) {
          spec.random_mesh_phase = value.is_word;
          spec.mesh_phase = value.number;
        }},
       {{.name = "columns",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .only_for = "rectangle",
         .doc = "Quads along the width.",
         .fallback_doc = "by `accuracy`; beside `rows` 8"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<RectangleMesh>(spec.mesh).columns = static_cast<int>(value.integer);
        }},
       {{.name = "rows",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .only_for = "rectangle",
         .doc = "Quads along the height.",
         .fallback_doc = "by `accuracy`; beside `columns` 8"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<RectangleMesh>(spec.mesh).rows = static_cast<int>(value.integer);
        }}}};
  return declaration;
}

}  // namespace pulvis::schema

// Declarations of the finite elements of a particle.
#include <array>
#include <concepts>
#include <utility>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

// A key of every mesh that has the member: only_for ensures that the selected one does.
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

constexpr auto set_edges = [](auto& mesh, int value) requires requires { mesh.boundary_edges; }
{ mesh.boundary_edges = value; };
constexpr auto set_rings = [](auto& mesh, int value) requires requires { mesh.rings; }
{ mesh.rings = value; };

// The words of the outlines whose meshes have what Set sets. Grains have no word.
template <class Set, std::size_t... outline>
Words words_with(std::index_sequence<outline...>) {
  const std::vector<Choice>& words = particle().keys.front().info.choices;  // ordered as Outline
  Words with;
  const std::array has{
      std::invocable<Set, typename std::variant_alternative_t<outline, Outline>::Mesh&, int>...};
  for (std::size_t i = 0; i < has.size(); ++i)
    if (has[i]) with.list.push_back(words[i].word);
  return with;
}
template <class Set>
Words outlines_with(const Set&) {
  return words_with<Set>(std::make_index_sequence<std::variant_size_v<Outline> - 1>());
}

}  // namespace

const TableDeclaration<ParticleSpec>& mesh() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle.mesh", false, "outline", "Finite element mesh of a particle."},
      {{{.name = "size",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Target edge length along the outline, instead of the numbers of edges and "
                "rings; finer where the outline has high curvature.",
         .fallback_doc = "set by `accuracy`"},
        [](ParticleSpec& spec, const Decoded& value) { spec.mesh_size = value.number; }},
       {{.name = "boundary_edges",
         .kind = Kind::integer,
         .range = within(4, 4096),
         .multiple_of = 4,
         .only_for = outlines_with(set_edges),
         .doc = "Number of edges along the outline; a uniform core has (boundary_edges/4)^2 "
                "quads. Corners with a small radius get four edges each, with edges growing "
                "towards the middle of the flat sides.",
         .fallback_doc = "set by `accuracy`; if another mesh size is given: 40, or 48 for outlines "
                         "other than disc and ring"},
        mesh_to(set_edges)},
       {{.name = "rings",
         .kind = Kind::integer,
         .range = within(0, 1024),
         .only_for = outlines_with(set_rings),
         .doc = "Number of rings of quads between core and outline, or through the wall of a "
                "ring; 0: core only, for discs with at most 20 boundary edges or a coarse core.",
         .fallback_doc = "set by `accuracy`; if another mesh size is given: 1, or 4 for a ring"},
        mesh_to(set_rings)},
       {{.name = "core",
         .kind = Kind::choice,
         .choices = words_of<DiscMesh::Core>(
             {{"even", "as fine as the outline"},
              {"coarse",
               "one edge for every three on the outline, joined by a ring of transition "
               "quads; boundary_edges must be a multiple of 12"}}),
         .only_for = "disc",
         .doc = "Mesh of the core inside the rings.",
         .fallback_doc = "set by `accuracy`; if another mesh size is given: `\"even\"`"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<DiscMesh>(spec.mesh).core = value_for<DiscMesh::Core>(value);
        }},
       {{.name = "refinement",
         .kind = Kind::number,
         .range = within(1, 100),
         .fallback = value_of(1.0),
         .only_for = "disc",
         .doc = "Factor by which edges at top and bottom are finer than at the sides."},
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
         .doc = "Rotation of the mesh inside the outline; \"random\" rotates the mesh of each "
                "particle individually."},
        [](ParticleSpec& spec, const Decoded& value) {
          spec.random_mesh_phase = value.is_word;
          spec.mesh_phase = value.number;
        }},
       {{.name = "columns",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .only_for = "rectangle",
         .doc = "Number of quads along the width.",
         .fallback_doc = "set by `accuracy`; 8 if `rows` is given"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<RectangleMesh>(spec.mesh).columns = static_cast<int>(value.integer);
        }},
       {{.name = "rows",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .only_for = "rectangle",
         .doc = "Number of quads along the height.",
         .fallback_doc = "set by `accuracy`; 8 if `columns` is given"},
        [](ParticleSpec& spec, const Decoded& value) {
          std::get<RectangleMesh>(spec.mesh).rows = static_cast<int>(value.integer);
        }}}};
  return declaration;
}

}  // namespace pulvis::schema

// Declarations of what a powder is made of: the top level, materials, particle classes.
#include "scenes/declare.hpp"

namespace pulvis::schema {
namespace {

DiscOutline& disc(ParticleSpec& particle) { return std::get<DiscOutline>(particle.outline); }
RectangleOutline& rectangle(ParticleSpec& particle) {
  return std::get<RectangleOutline>(particle.outline);
}
DiscMesh& disc_mesh(ParticleSpec& particle) { return std::get<DiscMesh>(particle.mesh); }
RectangleMesh& rectangle_mesh(ParticleSpec& particle) {
  return std::get<RectangleMesh>(particle.mesh);
}

// The first key of a particle: the keys after it find the outline and mesh they belong to.
void choose_outline(ParticleSpec& particle, const Decoded& value) {
  if (value.index == 0) {
    particle.outline = DiscOutline{};
    particle.mesh = DiscMesh{};
  } else {
    particle.outline = RectangleOutline{};
    particle.mesh = RectangleMesh{};
  }
}

}  // namespace

const TableDeclaration<Scene>& top_level() {
  static const TableDeclaration<Scene> declaration{
      {"", false, "", "Keys before the first table."},
      {{{.name = "family",
         .kind = Kind::choice,
         .choices = {{"compaction", "deformable particles in a rigid die, 2D plane strain"}},
         .required = true,
         .doc = "What kind of experiment this is."},
        nothing<Scene>},
       {{.name = "title",
         .kind = Kind::text,
         .fallback = value_of(""),
         .doc = "Heading of the report."},
        to(&Scene::title)},
       {{.name = "thickness",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .fallback = value_of("1 mm"),
         .doc = "Thickness of the plane-strain slice: forces are those on this slice."},
        to(&Scene::thickness)},
       {{.name = "seed",
         .kind = Kind::integer,
         .range = within(0, 1e15),
         .fallback = value_of(1),
         .doc = "Seed of everything random; the same seed gives the same run."},
        [](Scene& scene, const Decoded& value) {
          scene.seed = static_cast<std::uint64_t>(value.integer);
        }}}};
  return declaration;
}

const TableDeclaration<MaterialSpec>& material() {
  static const TableDeclaration<MaterialSpec> declaration{
      {"material", true, "", "A material: elastic, or elastic-plastic (J2) with a yield stress."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Particles and friction pairs refer to it."},
        to(&MaterialSpec::name)},
       {{.name = "density",
         .kind = Kind::quantity,
         .unit = "kg/m^3",
         .range = within(1e-3, 1e9),
         .required = true,
         .doc = "Mass per volume."},
        to(&MaterialSpec::density)},
       {{.name = "youngs_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1, 1e13),
         .required = true,
         .doc = "Stiffness in simple tension."},
        to(&MaterialSpec::youngs_modulus)},
       {{.name = "poissons_ratio",
         .kind = Kind::number,
         .range = between(-1, 0.5),
         .required = true,
         .doc = "Sideways contraction over extension."},
        to(&MaterialSpec::poissons_ratio)},
       {{.name = "yield_stress",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1e-3, 1e13),
         .doc = "Where plastic flow begins; below Young's modulus.",
         .fallback_doc = "the material stays elastic"},
        to(&MaterialSpec::yield_stress)},
       {{.name = "hardening_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .fallback = value_of("0 Pa"),
         .needs = "yield_stress",
         .doc = "Growth of the yield stress with plastic strain; 0 is perfectly plastic."},
        to(&MaterialSpec::hardening_modulus)}}};
  return declaration;
}

const TableDeclaration<ParticleSpec>& particle() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle", true, "outline", "A class of equal particles; bodies and packings place them."},
      {{{.name = "outline",
         .kind = Kind::choice,
         .choices = {{"disc", "a circle"}, {"rectangle", "sharp corners"}},
         .required = true,
         .doc = "Shape of the particle."},
        choose_outline},
       {{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Bodies and packings refer to it."},
        to(&ParticleSpec::name)},
       {{.name = "material",
         .kind = Kind::reference,
         .refers_to = "material",
         .required = true,
         .doc = "What it is made of."},
        index_to(&ParticleSpec::material)},
       {{.name = "diameter",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = "disc",
         .doc = "Diameter of the disc."},
        [](ParticleSpec& spec, const Decoded& value) { disc(spec).diameter = value.number; }},
       {{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = "rectangle",
         .doc = "Size along the particle's own x axis."},
        [](ParticleSpec& spec, const Decoded& value) { rectangle(spec).width = value.number; }},
       {{.name = "height",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = "rectangle",
         .doc = "Size along the particle's own y axis."},
        [](ParticleSpec& spec, const Decoded& value) { rectangle(spec).height = value.number; }}}};
  return declaration;
}

const TableDeclaration<ParticleSpec>& mesh() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle.mesh", false, "outline", "Finite elements of one particle."},
      {{{.name = "boundary_edges",
         .kind = Kind::integer,
         .range = within(8, 4096),
         .multiple_of = 4,
         .fallback = value_of(40),
         .only_for = "disc",
         .doc = "Edges along the outline; the core of the O-grid has (boundary_edges/4)^2 quads."},
        [](ParticleSpec& spec, const Decoded& value) {
          disc_mesh(spec).boundary_edges = static_cast<int>(value.integer);
        }},
       {{.name = "rings",
         .kind = Kind::integer,
         .range = within(1, 1024),
         .fallback = value_of(1),
         .only_for = "disc",
         .doc = "Rings of quads between the core and the outline."},
        [](ParticleSpec& spec, const Decoded& value) {
          disc_mesh(spec).rings = static_cast<int>(value.integer);
        }},
       {{.name = "refinement",
         .kind = Kind::number,
         .range = within(1, 100),
         .fallback = value_of(1.0),
         .only_for = "disc",
         .doc = "How much finer the edges at top and bottom are than those at the sides."},
        [](ParticleSpec& spec, const Decoded& value) {
          disc_mesh(spec).refinement = value.number;
        }},
       {{.name = "phase",
         .kind = Kind::phase,
         .unit = "rad",
         .range = within(-1000, 1000),
         .word = "random",
         .fallback = value_of("0 deg"),
         .only_for = "disc",
         .doc =
             "Turn of the mesh inside the outline; \"random\" turns each particle's by its own."},
        [](ParticleSpec& spec, const Decoded& value) {
          spec.random_mesh_phase = value.is_word;
          spec.mesh_phase = value.number;
        }},
       {{.name = "columns",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .fallback = value_of(8),
         .only_for = "rectangle",
         .doc = "Quads along the width."},
        [](ParticleSpec& spec, const Decoded& value) {
          rectangle_mesh(spec).columns = static_cast<int>(value.integer);
        }},
       {{.name = "rows",
         .kind = Kind::integer,
         .range = within(1, 4096),
         .fallback = value_of(8),
         .only_for = "rectangle",
         .doc = "Quads along the height."},
        [](ParticleSpec& spec, const Decoded& value) {
          rectangle_mesh(spec).rows = static_cast<int>(value.integer);
        }}}};
  return declaration;
}

}  // namespace pulvis::schema

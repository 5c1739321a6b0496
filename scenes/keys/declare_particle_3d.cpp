// Declarations of the particle classes: their shapes and their meshes.
#include <array>
#include <concepts>

#include "scenes/keys/declare_3d.hpp"

namespace pulvis::space::language {
namespace {

template <class Shape>
void emplace_shape(ParticleSpec& particle) {
  particle.shape = Shape{};
}

// The first key of a particle, words in this order: later keys find the shape they belong to.
void choose_shape(ParticleSpec& particle, const Decoded& value) {
  constexpr std::array choices{emplace_shape<SphereShape>,       emplace_shape<EllipsoidShape>,
                               emplace_shape<SuperquadricShape>, emplace_shape<CylinderShape>,
                               emplace_shape<PolyhedronShape>,   emplace_shape<StlShape>};
  static_assert(choices.size() == std::variant_size_v<ParticleShape>);
  choices.at(static_cast<std::size_t>(value.index))(particle);
}

// A key of every shape that has this member: the selected one has it, which only_for ensures.
template <class Value = double, class Set>
auto shape_to(Set set, Value Decoded::*member = &Decoded::number) {
  return [set, member](ParticleSpec& particle, const Decoded& value) {
    std::visit(
        [&](auto& shape) {
          if constexpr (std::invocable<Set, decltype(shape), const Value&>)
            set(shape, value.*member);
        },
        particle.shape);
  };
}

template <class Set>
Key<ParticleSpec> length_key(const char* name, schema::Range range, Words shapes, const char* doc,
                             Set set) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = range,
           .required = true,
           .only_for = std::move(shapes),
           .doc = doc},
          shape_to(set)};
}

template <class Set>
Key<ParticleSpec> exponent_key(const char* name, const char* doc, Set set) {
  return {{.name = name,
           .kind = Kind::number,
           .range = within(2, 20),
           .fallback = value_of(2.0),
           .only_for = "superquadric",
           .doc = doc},
          shape_to(set)};
}

std::vector<Key<ParticleSpec>> class_keys() {
  return {
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = {{"sphere", "a ball"},
                    {"ellipsoid", "three axes"},
                    {"superquadric", "between an ellipsoid and a box, depending on the exponents"},
                    {"cylinder", "along its z axis, with rounded rims: tablets, pellets"},
                    {"polyhedron", "the convex hull of its corners, with rounded edges"},
                    {"stl",
                     "a closed surface from a file; the whole surface must be visible from its "
                     "centre of volume"}},
        .required = true,
        .doc = "Shape of the particle."},
       choose_shape},
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Name by which bodies and packings refer to the particle."},
       to(&ParticleSpec::name)},
      {{.name = "material",
        .kind = Kind::reference,
        .refers_to = "material",
        .required = true,
        .doc = "Material of the particle."},
       schema::index_to(&ParticleSpec::material)}};
}

std::vector<Key<ParticleSpec>> size_keys_of_shapes() {
  Key<ParticleSpec> diameter = length_key(
      "diameter", within(smallest_size, largest_size), {"sphere", "cylinder", "stl"},
      "Diameter of a sphere or cylinder; for an STL surface, diameter of the sphere "
      "of equal volume, to which it is scaled.",
      [](auto& s, double value) requires requires { s.diameter; } { s.diameter = value; });
  diameter.info.optional_for = "stl";
  Key<ParticleSpec> rounding = length_key(
      "rounding", within(0, largest_size), {"cylinder", "polyhedron"},
      "Radius of the rims of a cylinder, or of all edges and corners of a "
      "polyhedron. Small radii need a fine mesh.",
      [](auto& s, double value) requires requires { s.rounding; } { s.rounding = value; });
  return {diameter,
          {{.name = "size",
            .kind = Kind::vector,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .required = true,
            .only_for = {"ellipsoid", "superquadric"},
            .doc = "Overall size along the particle's own x, y and z axes."},
           shape_to<Vec3>(
               [](auto& s, const Vec3& value) requires requires { s.size; } { s.size = value; },
               &Decoded::vector3)},
          length_key(
              "height", within(smallest_size, largest_size), {"cylinder"},
              "Distance between the end faces.",
              [](auto& s, double value) requires requires { s.height; } { s.height = value; }),
          rounding};
}

std::vector<Key<ParticleSpec>> form_keys() {
  return {
      exponent_key(
          "exponent_xy",
          "Exponent e in (abs(2x/a)^e + abs(2y/b)^e)^(f/e) + abs(2z/c)^f = 1: 2 gives an "
          "ellipse, larger values approach a rectangle.",
          [](auto& s, double value) requires requires { s.exponent_xy; } {
            s.exponent_xy = value;
          }),
      exponent_key(
          "exponent_z", "Exponent f in the same equation: shape towards both ends.",
          [](auto& s, double value) requires requires { s.exponent_z; } { s.exponent_z = value; }),
      {{.name = "corners",
        .kind = Kind::points,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .required = true,
        .only_for = "polyhedron",
        .doc = "At least four points that do not lie in one plane, in any order. The centre "
               "of volume becomes the particle's centre."},
       shape_to<std::vector<Vec3>>(
           [](auto& s, const std::vector<Vec3>& value) requires requires { s.corners; } {
             s.corners = value;
           },
           &Decoded::points3)}};
}

std::vector<Key<ParticleSpec>> file_keys() {
  return {
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "stl",
        .doc = "STL file (ASCII or binary) of a closed surface, as a path relative to the "
               "folder of the scene."},
       shape_to<std::string>(
           [](auto& s, const std::string& value) requires requires { s.file; } { s.file = value; },
           &Decoded::text)},
      {{.name = "unit",
        .kind = Kind::text,
        .required = true,
        .only_for = "stl",
        .doc = "Length unit of the file: \"um\"."},
       shape_to<std::string>(
           [](auto& s, const std::string& value) requires requires { s.unit; } { s.unit = value; },
           &Decoded::text)},
      {{.name = "smoothing",
        .kind = Kind::number,
        .range = within(0, 0.5),
        .fallback = value_of(0.0),
        .only_for = "stl",
        .doc = "Distance over which the surface is smoothed, as a fraction of the mean radius."},
       shape_to(
           [](auto& s, double value) requires requires { s.smoothing; } { s.smoothing = value; })}};
}

TableDeclaration<ParticleSpec> declared_particle() {
  TableDeclaration<ParticleSpec> table;
  table.info.path = "particle";
  table.info.repeated = true;
  table.info.selector = "shape";
  table.info.doc = "A class of identical particles, placed by bodies and packings.";
  for (const auto& keys : {class_keys(), size_keys_of_shapes(), form_keys(), file_keys()})
    table.keys.insert(table.keys.end(), keys.begin(), keys.end());
  return table;
}

std::vector<Key<ParticleSpec>> mesh_keys() {
  return {{{.name = "divisions",
            .kind = Kind::integer,
            .range = within(1, 64),
            .doc = "Elements along each edge of the central cube: the core has divisions^3 "
                   "elements and the surface 6 divisions^2 faces (with `axial_divisions` m: "
                   "divisions^2 m and 2 divisions^2 + 4 divisions m). The cube is aligned with "
                   "the axes of the shape; for polyhedra and STL shapes it is oriented for the "
                   "best contact resolution unless `axial_divisions` is given. A particle has at "
                   "most 100,000 elements.",
            .fallback_doc = "set by `accuracy`; 4 if `rings` is given"},
           [](ParticleSpec& spec, const Decoded& value) {
             spec.hex_mesh.divisions = static_cast<int>(value.integer);
           }},
          {{.name = "rings",
            .kind = Kind::integer,
            .range = within(1, 64),
            .doc = "Layers of elements between the core and the surface, each with as many "
                   "elements as the surface has faces.",
            .fallback_doc = "set by `accuracy`; 4 if `divisions` is given"},
           [](ParticleSpec& spec, const Decoded& value) {
             spec.hex_mesh.rings = static_cast<int>(value.integer);
           }},
          {{.name = "axial_divisions",
            .kind = Kind::integer,
            .range = within(2, 1024),
            .doc = "Elements of the core along z: more for long shapes, fewer for flat ones, to "
                   "keep the elements close to equal-sided.",
            .fallback_doc = "divisions"},
           [](ParticleSpec& spec, const Decoded& value) {
             spec.hex_mesh.axial_divisions = static_cast<int>(value.integer);
           }},
          {{.name = "grid",
            .kind = Kind::choice,
            .choices = words_of<HexMeshSpec::Grid>(
                {{"cube", "a cube at the centre, with layers around it"},
                 {"extruded",
                  "a disc mesh, a square at the centre with rings around it, extruded along z in "
                  "`axial_divisions` layers of divisions^2 + 4 divisions rings elements each: "
                  "for long cylinders and ends under impact; the rim radius must be less than "
                  "half an element"}}),
            .fallback = value_of("cube"),
            .only_for = "cylinder",
            .doc = "Topology of the mesh."},
           [](ParticleSpec& spec, const Decoded& value) {
             spec.hex_mesh.grid = value_for<HexMeshSpec::Grid>(value);
           }},
          {{.name = "phase",
            .kind = Kind::choice,
            .choices = {{"fixed", "the mesh rotates with the particle"},
                        {"random", "the mesh of each particle has its own random rotation"}},
            .fallback = value_of("fixed"),
            .only_for = "sphere",
            .doc = "Orientation of the mesh inside the shape."},
           [](ParticleSpec& spec, const Decoded& value) {
             spec.random_mesh_phase = value.index == 1;
           }}};
}

}  // namespace

const TableDeclaration<ParticleSpec>& particle() {
  static const TableDeclaration<ParticleSpec> declaration = declared_particle();
  return declaration;
}

const TableDeclaration<ParticleSpec>& mesh() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle.mesh", false, "shape",
       "Finite element mesh of a particle: an O-grid (a central cube with layers "
       "around it) or an extruded disc mesh."},
      mesh_keys()};
  return declaration;
}

}  // namespace pulvis::space::language

// Declarations of particle classes and their outlines.
#include <array>
#include <concepts>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

template <class O>
void emplace_outline(ParticleSpec& particle) {
  particle.outline = O{};
  particle.mesh = typename O::Mesh{};
}

// The first key of a particle, its words in this order: the keys after it access the outline and mesh
// that they belong to.
void choose_outline(ParticleSpec& particle, const Decoded& value) {
  constexpr std::array choices{emplace_outline<DiscOutline>,
                               emplace_outline<RectangleOutline>,
                               emplace_outline<RoundedRectangleOutline>,
                               emplace_outline<RingOutline>,
                               emplace_outline<EllipseOutline>,
                               emplace_outline<SuperellipseOutline>,
                               emplace_outline<PolygonOutline>,
                               emplace_outline<PointsOutline>,
                               emplace_outline<FourierOutline>};
  static_assert(choices.size() == std::variant_size_v<Outline> - 1);  // grains have no word
  choices.at(static_cast<std::size_t>(value.index))(particle);
}

// A key of every outline that has the member: only_for ensures that the selected one does.
template <class Value = double, class Set>
auto outline_to(Set set, Value Decoded::*member = &Decoded::number) {
  return [set, member](ParticleSpec& particle, const Decoded& value) {
    std::visit(
        [&](auto& outline) {
          if constexpr (std::invocable<Set, decltype(outline), const Value&>)
            set(outline, value.*member);
        },
        particle.outline);
  };
}

}  // namespace

const TableDeclaration<ParticleSpec>& particle() {
  static const TableDeclaration<ParticleSpec> declaration{
      {"particle", true, "outline",
       "A class of identical particles, placed by bodies and packings."},
      {{{.name = "outline",
         .kind = Kind::choice,
         .choices = {{"disc", "a circle"},
                     {"rectangle", "sharp corners"},
                     {"rounded_rectangle", "corners rounded by arcs"},
                     {"ring", "a tube; its hole is empty, and its inner surface has no contact"},
                     {"ellipse", "two axes"},
                     {"superellipse",
                      "between a rhombus and a rectangle, depending on the exponent"},
                     {"polygon", "regular, or defined by its corners; sharp or rounded"},
                     {"points", "a smooth curve through points from a file: a traced grain"},
                     {"fourier", "irregular, defined by the spectrum of its radius"}},
         .required = true,
         .doc = "Shape of the particle."},
        choose_outline},
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
        index_to(&ParticleSpec::material)},
       {{.name = "diameter",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = {"disc", "ring", "polygon", "points", "fourier"},
         .optional_for = {"polygon", "points"},
         .doc = "Outer diameter. For a regular polygon: diameter of the circumscribed circle. "
                "For points and fourier: diameter of the circle of equal area, to which the "
                "outline is scaled."},
        outline_to(
            [](auto& o, double value) requires requires { o.diameter; } { o.diameter = value; })},
       {{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = {"rectangle", "rounded_rectangle", "ellipse", "superellipse", "points"},
         .optional_for = "points",
         .doc = "Size along the particle's own x axis; points are scaled to it."},
        outline_to(
            [](auto& o, double value) requires requires { o.width; } { o.width = value; })},
       {{.name = "height",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = {"rectangle", "rounded_rectangle", "ellipse", "superellipse"},
         .doc = "Size along the particle's own y axis."},
        outline_to(
            [](auto& o, double value) requires requires { o.height; } { o.height = value; })},
       {{.name = "radius",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = {"rounded_rectangle"},
         .doc = "Radius of the four corners, at most half the shorter side."},
        outline_to(
            [](auto& o, double value) requires requires { o.radius; } { o.radius = value; })},
       {{.name = "hole",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .only_for = {"ring"},
         .doc = "Diameter of the hole; must be less than that of the ring."},
        outline_to(
            [](auto& o, double value) requires requires { o.hole; } { o.hole = value; })},
       {{.name = "exponent",
         .kind = Kind::number,
         .range = within(1.5, 20),
         .required = true,
         .only_for = "superellipse",
         .doc = "Exponent in abs(2x/width)^exponent + abs(2y/height)^exponent = 1: 2 gives an "
                "ellipse, larger values approach a rectangle, smaller ones a rhombus."},
        outline_to(
            [](auto& o, double value) requires requires { o.exponent; } { o.exponent = value; })},
       {{.name = "sides",
         .kind = Kind::integer,
         .range = within(3, 64),
         .only_for = "polygon",
         .needs = "diameter",
         .doc = "Number of sides of a regular polygon, with one side at the bottom."},
        outline_to<std::int64_t>(
            [](auto& o, std::int64_t value) requires requires { o.sides; } {
              o.sides = static_cast<int>(value);
            },
            &Decoded::integer)},
       {{.name = "corners",
         .kind = Kind::points,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .only_for = "polygon",
         .doc = "Corners of an irregular polygon, in order. The area centroid becomes the "
                "particle's centre. The whole outline must be visible from some interior point."},
        outline_to<std::vector<Vec2>>(
            [](auto& o, const std::vector<Vec2>& value) requires requires { o.corners; } {
              o.corners = value;
            },
            &Decoded::points)},
       {{.name = "rounding",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .fallback = value_of("0 m"),
         .only_for = "polygon",
         .doc = "Radius of all corners; 0: sharp, allowed only for polygons without re-entrant "
                "corners."},
        outline_to(
            [](auto& o, double value) requires requires { o.rounding; } { o.rounding = value; })},
       {{.name = "file",
         .kind = Kind::file,
         .required = true,
         .only_for = "points",
         .doc = "Path relative to the folder of the scene. CSV: one point x, y per line, in "
                "order; the first line may name the columns with their unit: x (um), y (um). "
                "SVG or DXF: the only closed outline in it."},
        outline_to<std::string>(
            [](auto& o, const std::string& value) requires requires { o.file; } { o.file = value; },
            &Decoded::text)},
       {{.name = "unit",
         .kind = Kind::text,
         .only_for = "points",
         .doc = "Unit of a file that does not specify one: \"um\".",
         .fallback_doc = "specified in the file"},
        outline_to<std::string>(
            [](auto& o, const std::string& value) requires requires { o.unit; } { o.unit = value; },
            &Decoded::text)},
       {{.name = "layer",
         .kind = Kind::text,
         .only_for = "points",
         .doc = "Part of a drawing to use: a layer of a DXF file; a group or shape of an SVG "
                "file, by its id or Inkscape label.",
         .fallback_doc = "the whole drawing"},
        outline_to<std::string>(
            [](auto& o, const std::string& value) requires requires { o.layer; } {
              o.layer = value;
            },
            &Decoded::text)},
       {{.name = "smoothing",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .fallback = value_of("0 m"),
         .only_for = "points",
         .doc = "Allowed root mean square distance between the curve and the points of the "
                "file, before scaling, to smooth tracing noise; 0: the curve passes through "
                "the points."},
        outline_to(
            [](auto& o, double value) requires requires { o.smoothing; } { o.smoothing = value; })},
       {{.name = "area",
         .kind = Kind::quantity,
         .unit = "m^2",
         .range = within(smallest_size * smallest_size, largest_size * largest_size),
         .only_for = "points",
         .doc = "Area to which the outline is scaled.",
         .fallback_doc = "the size in the file, unless `width` or `diameter` is given"},
        outline_to(
            [](auto& o, double value) requires requires { o.area; } { o.area = value; })},
       {{.name = "aspect_ratio",
         .kind = Kind::number,
         .range = within(1, 4),
         .fallback = value_of(1.0),
         .only_for = "fourier",
         .doc = "The outline is stretched along the particle's own x axis and compressed "
                "across it, so that a circle becomes an ellipse of this aspect ratio (length "
                "over width)."},
        outline_to(
            [](auto& o, double value) requires requires { o.aspect_ratio; } {
              o.aspect_ratio = value;
            })},
       {{.name = "irregularity",
         .kind = Kind::number,
         .range = within(0, 0.5),
         .fallback = value_of(0.0),
         .only_for = "fourier",
         .doc = "Deviation from a circle: amplitude of mode 3 of the radius divided by the "
                "mean radius. The modes up to 7 follow from it with `decay`. 0.1 is an angular "
                "grain."},
        outline_to(
            [](auto& o, double value) requires requires { o.irregularity; } {
              o.irregularity = value;
            })},
       {{.name = "roughness",
         .kind = Kind::number,
         .range = within(0, 0.2),
         .fallback = value_of(0.0),
         .only_for = "fourier",
         .doc = "Surface roughness: relative amplitude of mode 8. The modes up to `modes` "
                "follow from it. Needs a fine mesh."},
        outline_to(
            [](auto& o, double value) requires requires { o.roughness; } { o.roughness = value; })},
       {{.name = "decay",
         .kind = Kind::number,
         .range = within(0, 10),
         .fallback = value_of(2.0),
         .only_for = "fourier",
         .doc = "Mode n has the amplitude irregularity (n/3)^-decay, from mode 8 on roughness "
                "(n/8)^-decay."},
        outline_to(
            [](auto& o, double value) requires requires { o.decay; } { o.decay = value; })},
       {{.name = "modes",
         .kind = Kind::integer,
         .range = within(8, 64),
         .fallback = value_of(16),
         .only_for = "fourier",
         .needs = "roughness",
         .doc = "Highest mode of the roughness."},
        outline_to<std::int64_t>(
            [](auto& o, std::int64_t value) requires requires { o.modes; } {
              o.modes = static_cast<int>(value);
            },
            &Decoded::integer)},
       {{.name = "variant",
         .kind = Kind::integer,
         .range = within(0, 1e15),
         .fallback = value_of(1),
         .only_for = "fourier",
         .doc = "Selects an outline with this spectrum. The phases of the modes depend only on "
                "this number, not on the scene's `seed`, so packings read from files keep "
                "their outlines."},
        outline_to<std::int64_t>(
            [](auto& o, std::int64_t value) requires requires { o.variant; } {
              o.variant = static_cast<std::uint64_t>(value);
            },
            &Decoded::integer)},
       {{.name = "mirrored",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .only_for = {"polygon", "points"},
         .doc = "Mirror the outline, x to -x, before any rotation."},
        outline_to<bool>(
            [](auto& o, bool value) requires requires { o.mirrored; } { o.mirrored = value; },
            &Decoded::flag)}}};
  return declaration;
}

}  // namespace pulvis::schema

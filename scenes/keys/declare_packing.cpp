// Declarations of packings: lattices, random packings of mixtures in a die, positions from a file.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

constexpr Dimension two = Dimension::two, three = Dimension::three;

// Of either dimension; keys lose the words of the other one.
const Words lattices{"square", "cubic", "body-centred", "face-centred", "hexagonal"};
const Words with_corner{"square", "cubic", "body-centred", "face-centred", "hexagonal", "random"};

Key<PackingSpec> kind_key() {
  return {{.name = "kind",
           .kind = Kind::choice,
           .choices = words_of<PackingSpec::Kind>(
               {{"square", "rows and columns of a square lattice", "", two},
                {"cubic", "simple cubic: one particle at the centre of each cell", "", three},
                {"body-centred",
                 "body-centred cubic: particles at the corners and centres of cells; between "
                 "flat walls only whole particles: half a cell off the walls",
                 "", three},
                {"face-centred",
                 "face-centred cubic: particles at the corners and face centres of cells; only "
                 "whole particles",
                 "", three},
                {"hexagonal",
                 "in two dimensions rows sqrt(3)/2 of the spacing apart; every second row has one "
                 "particle less and lies in the gaps of the row below, so the packing is symmetric "
                 "between flat walls. In three close-packed layers, ABAB"},
                {"random",
                 "a mixture, [[packing.class]], poured into a die or a container as rigid "
                 "particles and compressed without friction while shaken until it reaches the "
                 "required density; the same `seed` gives the same packing on every machine"},
                {"csv", "from a file as written by `pulvis pack`"}}),
           .required = true,
           .doc = "Arrangement of the particles."},
          word_to(&PackingSpec::kind)};
}

std::vector<Key<PackingSpec>> lattice_keys() {
  return {{{.name = "particle",
            .kind = Kind::reference,
            .refers_to = "particle",
            .required = true,
            .only_for = lattices,
            .doc = "Particle class."},
           index_to(&PackingSpec::particle)},
          {{.name = "rows",
            .kind = Kind::integer,
            .range = within(1, 1e6),
            .required = true,
            .only_for = lattices,
            .doc = "Number of particles on top of each other.",
            .dimension = two},
           [](PackingSpec& packing, const Decoded& value) {
             packing.cells[1] = static_cast<int>(value.integer);
           }},
          {{.name = "columns",
            .kind = Kind::integer,
            .range = within(1, 1e6),
            .required = true,
            .only_for = lattices,
            .doc = "Number of particles side by side in the lowest row.",
            .dimension = two},
           [](PackingSpec& packing, const Decoded& value) {
             packing.cells[0] = static_cast<int>(value.integer);
           }},
          {{.name = "cells",
            .kind = Kind::counts,
            .range = within(1, 1000),
            .required = true,
            .only_for = lattices,
            .doc = "Number of cells of the lattice along x, y and z; hexagonal: particles per "
                   "row, rows per layer, layers.",
            .dimension = three},
           [](PackingSpec& packing, const Decoded& value) { packing.cells = value.counts3; }},
          {{.name = "spacing",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .only_for = lattices,
            .doc = "Centre-to-centre distance; required for rectangles.",
            .fallback_doc = "the diameter of the discs or rings, so that they touch",
            .in_3d = {.doc = "Edge of the cubic cell; hexagonal: distance between neighbours. "
                             "Required except for spheres.",
                      .fallback_doc = "that at which spheres touch"}},
           to(&PackingSpec::spacing)},
          {{.name = "perturbation",
            .kind = Kind::number,
            .range = within(0, 0.5),
            .fallback = value_of(0.0),
            .only_for = lattices,
            .doc = "Maximum random displacement of a centre from its lattice site, as a fraction "
                   "of the spacing: drawn with the scene's `seed`, uniformly over a circle. The "
                   "spacing must leave room for it.",
            .in_3d = {.doc = "Maximum random displacement of a centre from its lattice site, as a "
                             "fraction of the spacing: drawn with the scene's `seed`, uniformly "
                             "over a ball. The spacing must leave room for it."}},
           to(&PackingSpec::perturbation)}};
}

Key<PackingSpec> container_length(const char* name, double ContainerSpec::*member, const char* doc,
                                  const char* without_it) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .only_for = "random",
           .doc = doc,
           .fallback_doc = without_it,
           .dimension = three},
          [member](PackingSpec& packing, const Decoded& value) {
            packing.container.*member = value.number;
          }};
}

Key<PackingSpec> corner_key() {
  return {
      {.name = "corner",
       .kind = Kind::vector,
       .unit = "m",
       .range = within(-largest_size, largest_size),
       .fallback = zero_vector("0 m"),
       .only_for = with_corner,
       .doc = "Lower left corner of the lattice cell of the first particle, or of the die.",
       .in_3d = {.doc = "Corner with the smallest x, y and z of the first lattice cell or of "
                        "the box; for a cylinder, the centre of its floor."}},
      [](PackingSpec& packing, const Decoded& value) { packing.container.corner = value.vector3; }};
}

std::vector<Key<PackingSpec>> container_keys() {
  const auto die_width = [] {
    auto key = container_length("width", &ContainerSpec::width, "Distance between the die walls.",
                                "that of `[die]`; required without one");
    key.info.dimension = two;
    return key;
  };
  const auto box_length = [](const char* name, const char* other, double ContainerSpec::*member,
                             const char* doc) {
    auto key = container_length(name, member, doc, "required except for a cylinder");
    key.info.needs = other;
    return key;
  };
  Key<PackingSpec> diameter =
      container_length("diameter", &ContainerSpec::diameter,
                       "Diameter of a cylinder along z, instead of a box.", "a box");
  diameter.set = [](PackingSpec& packing, const Decoded& value) {
    packing.container.kind = ContainerSpec::Kind::cylinder;
    packing.container.diameter = value.number;
  };
  return {corner_key(), die_width(),
          box_length("width", "depth", &ContainerSpec::width, "Size of the box along x."),
          box_length("depth", "width", &ContainerSpec::depth, "Size of the box along y."),
          diameter};
}

Key<PackingSpec> density_key() {
  return {
      {.name = "density",
       .kind = Kind::number,
       .range = within(0.05, 0.999),
       .choices = {{"touching", "until all motion has ceased"},
                   {"densest",
                    "shaking and compression then continue as long as they increase the density; "
                    "discs of equal size crystallise in the process"}},
       .only_for = "random",
       .doc = "Relative density of the filled die: area of the particles divided by that of "
              "the die up to its top. Discs and similar shapes settle at 0.76 to 0.84. "
              "Higher densities, up to the maximum, take longer; densities above the maximum "
              "are refused.",
       .fallback_doc = "from count and height",
       .in_3d = {.doc =
                     "Relative density up to the top: volume of the particles divided by that of "
                     "the box or cylinder. Spheres settle at 0.55 to 0.64, less in a narrow "
                     "box; higher densities are refused."}},
      [](PackingSpec& packing, const Decoded& value) {
        using Dense = PackingSpec::Dense;
        if (value.is_word)
          packing.dense = value.index == 0 ? Dense::touching : Dense::densest;
        else
          packing.density = value.number;
      }};
}

std::vector<Key<PackingSpec>> amount_keys() {
  return {{{.name = "height",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .only_for = "random",
            .doc = "Height from the floor to the top of the die. Two of count, density and height "
                   "must be given.",
            .fallback_doc = "from count and density",
            .in_3d = {.doc = "Height from the floor to the top. Two of count, density and height "
                             "must be given."}},
           to(&PackingSpec::height)},
          {{.name = "count",
            .kind = Kind::integer,
            .range = within(1, 1e5),
            .only_for = "random",
            .doc = "Total number of particles of all classes, if those specify fractions.",
            .fallback_doc = "the sum of the numbers of the classes, or from density and height"},
           integer_to(&PackingSpec::count)},
          density_key()};
}

Key<PackingSpec> file_key() {
  return {{.name = "file",
           .kind = Kind::file,
           .required = true,
           .only_for = "csv",
           .doc = "Path relative to the folder of the scene. The columns are class, x, y, angle, "
                  "and scale if outlines differ in size from their class. Units are in the "
                  "header: `x [mm]`. Lines starting with # are comments. A line `# top: 0.1 m` "
                  "sets the height at which a punch rests; by default it rests on the highest "
                  "particle.",
           .in_3d = {.doc = "Path relative to the folder of the scene. The columns are class, x, "
                            "y, z, the rotation as a quaternion qw, qx, qy, qz, and scale if "
                            "shapes differ in size from their class. Units are in the header: "
                            "`x [mm]`. Lines starting with # are comments. A line `# top: 0.1 m` "
                            "sets the height at which a punch rests; by default it rests on the "
                            "highest particle."}},
          to(&PackingSpec::file)};
}

TableDeclaration<PackingSpec> declared_packing() {
  TableDeclaration<PackingSpec> table;
  table.info.path = "packing";
  table.info.repeated = true;
  table.info.selector = "kind";
  table.info.doc =
      "A packing of many particles. Lattice particles are numbered row by row from "
      "the bottom, particles of a random packing class by class.";
  table.info.doc_3d =
      "A packing of many particles. Lattice particles are numbered along x, then y, "
      "then z, particles of a random packing class by class.";
  table.keys.push_back(kind_key());
  for (const auto& keys : {lattice_keys(), container_keys(), amount_keys()})
    table.keys.insert(table.keys.end(), keys.begin(), keys.end());
  table.keys.push_back(file_key());
  return table;
}

std::vector<Key<MixtureClass>> share_keys() {
  return {
      {{.name = "particle",
        .kind = Kind::reference,
        .refers_to = "particle",
        .required = true,
        .doc = "Particle class."},
       index_to(&MixtureClass::particle)},
      {{.name = "number",
        .kind = Kind::integer,
        .range = within(1, 1e5),
        .doc = "Number of particles. In a mixture either all classes have a number, or all "
               "have a fraction of the same kind. A single class needs neither.",
        .fallback_doc = "from the fractions"},
       [](MixtureClass& mixed, const Decoded& value) {
         mixed.number = static_cast<int>(value.integer);
       }},
      {{.name = "number_fraction",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Number fraction; the fractions of all classes sum to 1.",
        .fallback_doc = "none"},
       [](MixtureClass& mixed, const Decoded& value) { mixed.number_fraction = value.number; }},
      {{.name = "area_fraction",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Area fraction; the fractions of all classes sum to 1.",
        .fallback_doc = "none",
        .dimension = Dimension::two},
       [](MixtureClass& mixed, const Decoded& value) { mixed.content_fraction = value.number; }},
      {{.name = "volume_fraction",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Volume fraction; the fractions of all classes sum to 1.",
        .fallback_doc = "none",
        .dimension = Dimension::three},
       [](MixtureClass& mixed, const Decoded& value) { mixed.content_fraction = value.number; }}};
}

Key<MixtureClass> size_key(const char* name, double SizeLaw::*member, Words laws, const char* doc) {
  return {
      {.name = name,
       .kind = Kind::quantity,
       .unit = "m",
       .range = within(smallest_size, largest_size),
       .required = true,
       .only_for = std::move(laws),
       .doc = doc},
      [member](MixtureClass& mixed, const Decoded& value) { mixed.size.*member = value.number; }};
}

Key<MixtureClass> limit_key(const char* name, const char* formerly,
                            std::optional<double> SizeLaw::*member, const char* doc) {
  return {
      {.name = name,
       .formerly = formerly,
       .kind = Kind::quantity,
       .unit = "m",
       .range = within(smallest_size, largest_size),
       .only_for = {"uniform", "normal", "lognormal"},
       .doc = doc,
       .fallback_doc = "required for `\"uniform\"`; by default `\"lognormal\"` is not cut off and "
                       "`\"normal\"` is cut off at three standard deviations from the mean"},
      [member](MixtureClass& mixed, const Decoded& value) { mixed.size.*member = value.number; }};
}

Key<MixtureClass> distribution_key() {
  return {
      {.name = "distribution",
       .kind = Kind::choice,
       .choices =
           words_of<SizeLaw::Kind>({{"mono", "all particles have the size of the class"},
                                    {"uniform", "uniform from `minimum` to `maximum`"},
                                    {"normal", "truncated at `minimum` and `maximum`"},
                                    {"lognormal", "truncated at `minimum` and `maximum`"},
                                    {"sieve", "sieve curve by area or volume, from a file"}}),
       .fallback = value_of("mono"),
       .doc = "Size distribution by number of particles; \"sieve\": by area. The size of a "
              "particle is the smallest width of its outline, which determines the sieve it "
              "passes: the diameter of a disc, the shorter side of a rectangle. The outline "
              "of the class is scaled to it.",
       .in_3d = {.doc = "Size distribution by number of particles; \"sieve\": by volume. The size "
                        "of a particle determines the sieve it passes: its smallest width "
                        "perpendicular to its thinnest direction. This is the diameter of a "
                        "sphere or flat tablet, and the middle one of the three axes of an "
                        "ellipsoid. The shape of the class is scaled to it."}},
      [](MixtureClass& mixed, const Decoded& value) {
        mixed.size.kind = value_for<SizeLaw::Kind>(value);
      }};
}

std::vector<Key<MixtureClass>> size_keys() {
  return {
      distribution_key(),
      size_key("mean", &SizeLaw::mean, {"normal", "lognormal"},
               "Mean size by number, before truncation."),
      size_key("deviation", &SizeLaw::deviation, {"normal", "lognormal"},
               "Standard deviation of the size, before truncation."),
      limit_key("minimum", "least", &SizeLaw::minimum, "Minimum size."),
      limit_key("maximum", "largest", &SizeLaw::maximum, "Maximum size."),
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "sieve",
        .doc = "Path relative to the folder of the scene. The columns are size (unit in the "
               "header, `size [mm]`) and passing: the fraction of smaller particles, by area or in "
               "three dimensions by volume, rising from 0 to 1, linearly interpolated."},
       [](MixtureClass& mixed, const Decoded& value) { mixed.size.file = value.text; }},
      {{.name = "sizes",
        .kind = Kind::integer,
        .range = within(1, 256),
        .fallback = value_of(8),
        .only_for = {"uniform", "normal", "lognormal", "sieve"},
        .doc = "Number of discrete sizes that represent the distribution. Each stands for an "
               "equal fraction of it (of the particles; for \"sieve\" of the area or volume) and "
               "has the mean area or volume of its fraction. Particles of one size share a mesh "
               "and are computed eight at a time, so each size should have many particles."},
       [](MixtureClass& mixed, const Decoded& value) {
         mixed.size.sizes = static_cast<int>(value.integer);
       }}};
}

TableDeclaration<MixtureClass> declared_class() {
  TableDeclaration<MixtureClass> table;
  table.info.path = "packing.class";
  table.info.repeated = true;
  table.info.selector = "distribution";
  table.info.doc = "A class of particles in a random packing: number and size.";
  table.keys = share_keys();
  for (auto& key : size_keys()) table.keys.push_back(std::move(key));
  return table;
}

}  // namespace

const TableDeclaration<PackingSpec>& packing() {
  static const TableDeclaration<PackingSpec> declaration = declared_packing();
  return declaration;
}

const TableDeclaration<MixtureClass>& mixture_class() {
  static const TableDeclaration<MixtureClass> declaration = declared_class();
  return declaration;
}

}  // namespace pulvis::schema

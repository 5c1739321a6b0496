// Declarations of packings: lattices, random packings of mixtures in a die, positions from a file.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/packing_keys.hpp"

namespace pulvis::schema {
namespace {

const Words lattices{"square", "hexagonal"};

std::vector<Key<PackingSpec>> lattice_keys() {
  return {class_of_lattice_key<PackingSpec>(lattices),
          {{.name = "rows",
            .kind = Kind::integer,
            .range = within(1, 1e6),
            .required = true,
            .only_for = lattices,
            .doc = "Particles on top of each other."},
           integer_to(&PackingSpec::rows)},
          {{.name = "columns",
            .kind = Kind::integer,
            .range = within(1, 1e6),
            .required = true,
            .only_for = lattices,
            .doc = "Particles side by side, in the lowest row."},
           integer_to(&PackingSpec::columns)},
          {{.name = "spacing",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .only_for = lattices,
            .doc = "Distance from centre to centre; must be given for rectangles.",
            .fallback_doc = "the diameter of the discs or rings: they touch"},
           to(&PackingSpec::spacing)},
          {{.name = "perturbation",
            .kind = Kind::number,
            .range = within(0, 0.5),
            .fallback = value_of(0.0),
            .only_for = lattices,
            .doc = "How far a centre may be off its place, as a share of the spacing: at random by "
                   "the scene's `seed`, evenly over a circle. The spacing must leave room for it."},
           to(&PackingSpec::perturbation)}};
}

Key<PackingSpec> kind_key() {
  return {{.name = "kind",
           .kind = Kind::choice,
           .choices = {{"square", "rows and columns on a square lattice"},
                       {"hexagonal",
                        "rows sqrt(3)/2 of the spacing apart; every second one has one particle "
                        "less and lies in the gaps of those below, so that the packing is "
                        "symmetric between flat walls"},
                       {"random",
                        "a mixture, [[packing.class]], thrown into a die and pressed together "
                        "without friction under shaking, as rigid particles, until it is as dense "
                        "as wanted; the same `seed` gives the same packing on every machine"},
                       {"csv", "where a file says, as `pulvis pack` writes it"}},
           .required = true,
           .doc = "How the particles are arranged."},
          [](PackingSpec& packing, const Decoded& value) {
            packing.kind = static_cast<PackingSpec::Kind>(value.index);
          }};
}

std::vector<Key<PackingSpec>> die_keys() {
  return {
      {{.name = "corner",
        .kind = Kind::vector,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .fallback = pair_of("0 m", "0 m"),
        .only_for = {"square", "hexagonal", "random"},
        .doc = "Lower left corner of the first particle's lattice cell, or of the die."},
       to(&PackingSpec::corner)},
      {{.name = "width",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "random",
        .doc = "Between the die's walls.",
        .fallback_doc = "that of `[die]`; required without one"},
       to(&PackingSpec::width)},
      height_key<PackingSpec>(
          "From the die's floor to its top. Two of count, density and height are given."),
      count_key<PackingSpec>(),
      density_key<PackingSpec>(
          "then shaken on and pressed again, as long as that pays; equal discs order themselves "
          "meanwhile",
          "Relative density of the die up to its top: area of the particles over that of the die. "
          "Discs and the like come to rest at 0.76 to 0.84 by themselves; from there on to the "
          "densest it takes longer, and beyond that it is refused.")};
}

Key<PackingSpec> file_key() {
  return file_of_packing_key<PackingSpec>(
      "Path from the scene's folder. Columns class, x, y, angle, and scale where outlines are not "
      "as the class says; units in the header, `x [mm]`. Lines with # are comments; one "
      "`# top: 0.1 m` says where a punch rests, otherwise it rests on the highest particle.");
}

TableDeclaration<PackingSpec> declared_packing() {
  TableDeclaration<PackingSpec> table;
  table.info.path = "packing";
  table.info.repeated = true;
  table.info.selector = "kind";
  table.info.doc =
      "Many particles at once. Those of a lattice are numbered row by row from the bottom, those "
      "of "
      "a random packing class by class.";
  table.keys.push_back(kind_key());
  for (auto& key : lattice_keys()) table.keys.push_back(std::move(key));
  for (auto& key : die_keys()) table.keys.push_back(std::move(key));
  table.keys.push_back(file_key());
  return table;
}

std::vector<Key<MixtureClass>> share_keys() {
  return {
      {{.name = "particle",
        .kind = Kind::reference,
        .refers_to = "particle",
        .required = true,
        .doc = "Class of the particles."},
       index_to(&MixtureClass::particle)},
      {{.name = "number",
        .kind = Kind::integer,
        .range = within(1, 1e5),
        .doc = "Of particles. Every class of a mixture has a number, or every one a fraction of "
               "the same kind; without any of them a single class is all of it.",
        .fallback_doc = "by the fractions"},
       [](MixtureClass& mixed, const Decoded& value) {
         mixed.number = static_cast<int>(value.integer);
       }},
      {{.name = "number_fraction",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Share of all particles; the classes' sum is 1.",
        .fallback_doc = "none"},
       [](MixtureClass& mixed, const Decoded& value) { mixed.number_fraction = value.number; }},
      {{.name = "area_fraction",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Share of the area of all particles; the classes' sum is 1.",
        .fallback_doc = "none"},
       [](MixtureClass& mixed, const Decoded& value) { mixed.area_fraction = value.number; }}};
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
       .fallback_doc = "required of `\"uniform\"`; `\"lognormal\"` goes on, `\"normal\"` ends "
                       "three deviations from the mean"},
      [member](MixtureClass& mixed, const Decoded& value) { mixed.size.*member = value.number; }};
}

Key<MixtureClass> distribution_key() {
  return {
      {.name = "distribution",
       .kind = Kind::choice,
       .choices = {{"mono", "all as the class says"},
                   {"uniform", "all sizes from `minimum` to `maximum` alike"},
                   {"normal", "cut off at `minimum` and `maximum`"},
                   {"lognormal", "cut off at `minimum` and `maximum`"},
                   {"sieve", "what passes each sieve, by area, from a file"}},
       .fallback = value_of("mono"),
       .doc = "Law of the sizes: by number of particles, \"sieve\" by their area. The size of a "
              "particle is the smallest width of its outline, which a sieve lets through: of a "
              "disc its diameter, of a rectangle its shorter side. The outline of the class is "
              "scaled to it."},
      [](MixtureClass& mixed, const Decoded& value) {
        mixed.size.kind = static_cast<SizeLaw::Kind>(value.index);
      }};
}

std::vector<Key<MixtureClass>> size_keys() {
  return {distribution_key(),
          size_key("mean", &SizeLaw::mean, {"normal", "lognormal"},
                   "Mean size, by number, before the law is cut off."),
          size_key("deviation", &SizeLaw::deviation, {"normal", "lognormal"},
                   "Standard deviation of the size, before the law is cut off."),
          limit_key("minimum", "least", &SizeLaw::minimum, "No particle is smaller."),
          limit_key("maximum", "largest", &SizeLaw::maximum, "No particle is larger."),
          {{.name = "file",
            .kind = Kind::file,
            .required = true,
            .only_for = "sieve",
            .doc = "Path from the scene's folder. Columns size (unit in the header, `size [mm]`) "
                   "and passing: the share of the area that is smaller, rising from 0 to 1, "
                   "straight in between."},
           [](MixtureClass& mixed, const Decoded& value) { mixed.size.file = value.text; }},
          {{.name = "sizes",
            .kind = Kind::integer,
            .range = within(1, 256),
            .fallback = value_of(8),
            .only_for = {"uniform", "normal", "lognormal", "sieve"},
            .doc = "How many sizes stand for the law, each for the same share of it (of the "
                   "particles, of \"sieve\" of the area) and with its share's mean area. Particles "
                   "of one size share their mesh and are computed eight at a time: choose this so "
                   "that many particles have each."},
           [](MixtureClass& mixed, const Decoded& value) {
             mixed.size.sizes = static_cast<int>(value.integer);
           }}};
}

TableDeclaration<MixtureClass> declared_class() {
  TableDeclaration<MixtureClass> table;
  table.info.path = "packing.class";
  table.info.repeated = true;
  table.info.selector = "distribution";
  table.info.doc = "Of a random packing: how many particles of a class, and how large.";
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

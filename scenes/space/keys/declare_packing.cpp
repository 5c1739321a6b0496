// Declarations of packings: lattices, random packings of mixtures in a box or cylinder, places from a file.
#include "scenes/keys/packing_keys.hpp"
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {
namespace {

const Words space_lattices{"cubic", "body-centred", "face-centred", "hexagonal"};

Key<PackingSpec> kind_of_packing() {
  return {{.name = "kind",
           .kind = Kind::choice,
           .choices = {{"cubic", "a particle in the middle of every cell"},
                       {"body-centred",
                        "particles at the corners and in the middle of cells; "
                        "between flat walls whole particles alone: half a cell off "
                        "the walls"},
                       {"face-centred",
                        "particles at the corners and on the faces of cells, whole "
                        "ones alone"},
                       {"hexagonal", "closely packed layers, ABAB"},
                       {"random",
                        "a mixture, [[packing.class]], thrown into a box or cylinder and "
                        "pressed together without friction under shaking, as rigid "
                        "particles, until it is as dense as wanted; the same `seed` gives "
                        "the same packing on every machine"},
                       {"csv", "where a file says, as `pulvis pack` writes it"}},
           .required = true,
           .doc = "How the particles are arranged."},
          [](PackingSpec& packing, const Decoded& value) {
            packing.kind = static_cast<PackingSpec::Kind>(value.index);
          }};
}

std::vector<Key<PackingSpec>> keys_of_lattices() {
  return {
      schema::class_of_lattice_key<PackingSpec>(space_lattices),
      {{.name = "cells",
        .kind = Kind::counts,
        .range = within(1, 1000),
        .dimensions = 3,
        .required = true,
        .only_for = space_lattices,
        .doc = "Cells of the lattice along x, y and z; hexagonal: particles of a row, rows of a "
               "layer, layers."},
       [](PackingSpec& packing, const Decoded& value) { packing.cells = value.counts3; }},
      {{.name = "spacing",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = space_lattices,
        .doc = "Edge of the cubic cell; hexagonal: distance of neighbours. Must be given but for "
               "spheres.",
        .fallback_doc = "that at which spheres touch"},
       to(&PackingSpec::spacing)}};
}

Key<PackingSpec> container_length(const char* name, const char* needs, const char* doc,
                                  const char* without_it, double ContainerSpec::*member) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .only_for = "random",
           .needs = needs,
           .doc = doc,
           .fallback_doc = without_it},
          [member](PackingSpec& packing, const Decoded& value) {
            packing.container.*member = value.number;
          }};
}

std::vector<Key<PackingSpec>> container_keys() {
  Key<PackingSpec> diameter =
      container_length("diameter", "", "Of a cylinder along z, instead of a box.", "a box",
                       &ContainerSpec::diameter);
  diameter.set = [](PackingSpec& packing, const Decoded& value) {
    packing.container.kind = ContainerSpec::Kind::cylinder;
    packing.container.diameter = value.number;
  };
  return {{{.name = "corner",
            .kind = Kind::vector,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .dimensions = 3,
            .fallback = triple_of("0 m", "0 m", "0 m"),
            .only_for = {"cubic", "body-centred", "face-centred", "hexagonal", "random"},
            .doc = "Corner of the lattice's first cell, or of the box, where x, y and z are least; "
                   "of a cylinder the centre of its floor."},
           [](PackingSpec& packing, const Decoded& value) {
             packing.container.corner = value.vector3;
           }},
          container_length("width", "depth", "Of the box, along x.", "required, but for a cylinder",
                           &ContainerSpec::width),
          container_length("depth", "width", "Of the box, along y.", "required, but for a cylinder",
                           &ContainerSpec::depth),
          diameter};
}

std::vector<Key<PackingSpec>> keys_of_random() {
  return {schema::height_key<PackingSpec>(
              "From the floor to the top. Two of count, density and height are given."),
          schema::count_key<PackingSpec>(),
          schema::density_key<PackingSpec>(
              "then shaken on and pressed again, as long as that pays",
              "Relative density up to the top: volume of the particles over that of the box or "
              "cylinder. Spheres come to rest at 0.55 to 0.64 by themselves, less in a narrow box; "
              "denser ones are refused.")};
}

Key<PackingSpec> packing_file() {
  return schema::file_of_packing_key<PackingSpec>(
      "Path from the scene's folder. Columns class, x, y, z, the rotation as a quaternion qw, qx, "
      "qy, qz, and scale where shapes are not as the class says; units in the header, `x [mm]`. "
      "Lines with # are comments; one `# top: 0.1 m` says where a punch rests, otherwise it rests "
      "on the highest particle.");
}

TableDeclaration<PackingSpec> declared_packing_in_space() {
  TableDeclaration<PackingSpec> table;
  table.info.path = "packing";
  table.info.repeated = true;
  table.info.selector = "kind";
  table.info.doc =
      "Many particles at once. Those of a lattice are numbered along x, then y, then z, those of a "
      "random packing class by class.";
  table.keys.push_back(kind_of_packing());
  for (const auto& keys : {keys_of_lattices(), container_keys(), keys_of_random()})
    table.keys.insert(table.keys.end(), keys.begin(), keys.end());
  table.keys.push_back(packing_file());
  return table;
}

}  // namespace

const TableDeclaration<PackingSpec>& packing() {
  static const TableDeclaration<PackingSpec> declaration = declared_packing_in_space();
  return declaration;
}

// As in two dimensions, of volumes instead of areas.
const TableDeclaration<MixtureClass>& mixture_class() {
  static const TableDeclaration<MixtureClass> declaration = [] {
    TableDeclaration<MixtureClass> table = schema::mixture_class();
    schema::KeyInfo& share = key_of(table, "area_fraction").info;
    share.name = "volume_fraction";
    share.doc = "Share of the volume of all particles; the classes' sum is 1.";
    schema::KeyInfo& law = key_of(table, "distribution").info;
    law.choices.back().doc = "what passes each sieve, by volume, from a file";
    law.doc =
        "Law of the sizes: by number of particles, \"sieve\" by their volume. The size of a "
        "particle "
        "is what a sieve lets through: its least width across the direction in which it is "
        "thinnest; "
        "of a sphere the diameter, of an ellipsoid the middle one of three, of a flat tablet its "
        "diameter, too. The shape of the class is scaled to it.";
    key_of(table, "file").info.doc =
        "Path from the scene's folder. Columns size (unit in the header, `size [mm]`) and passing: "
        "the share of the volume that is smaller, rising from 0 to 1, straight in between.";
    key_of(table, "sizes").info.doc =
        "How many sizes stand for the law, each for the same share of it (of the particles, of "
        "\"sieve\" of the volume) and with its share's mean volume. Particles of one size share "
        "their mesh and are computed eight at a time: choose this so that many particles have "
        "each.";
    return table;
  }();
  return declaration;
}

}  // namespace pulvis::space::language

// Declarations of packings: lattices, random mixtures in a box or cylinder, positions from a file.
#include "scenes/keys/packing_keys.hpp"
#include "scenes/keys/declare_3d.hpp"

namespace pulvis::space::language {
namespace {

const Words space_lattices{"cubic", "body-centred", "face-centred", "hexagonal"};

Key<PackingSpec> kind_of_packing() {
  return {{.name = "kind",
           .kind = Kind::choice,
           .choices = words_of<PackingSpec::Kind>(
               {{"cubic", "simple cubic: one particle at the centre of each cell"},
                {"body-centred",
                 "body-centred cubic: particles at the corners and centres of cells; between "
                 "flat walls only whole particles: half a cell off the walls"},
                {"face-centred",
                 "face-centred cubic: particles at the corners and face centres of cells; only "
                 "whole particles"},
                {"hexagonal", "hexagonal close-packed layers, ABAB"},
                {"random",
                 "a mixture, [[packing.class]], poured into a box or cylinder as rigid "
                 "particles and compressed without friction while shaken until it reaches the "
                 "required density; the same `seed` gives the same packing on every machine"},
                {"csv", "from a file as written by `pulvis pack`"}}),
           .required = true,
           .doc = "Arrangement of the particles."},
          word_to(&PackingSpec::kind)};
}

std::vector<Key<PackingSpec>> keys_of_lattices() {
  return {schema::class_of_lattice_key<PackingSpec>(space_lattices),
          {{.name = "cells",
            .kind = Kind::counts,
            .range = within(1, 1000),
            .required = true,
            .only_for = space_lattices,
            .doc = "Number of cells of the lattice along x, y and z; hexagonal: particles per "
                   "row, rows per layer, layers."},
           [](PackingSpec& packing, const Decoded& value) { packing.cells = value.counts3; }},
          {{.name = "spacing",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .only_for = space_lattices,
            .doc = "Edge of the cubic cell; hexagonal: distance between neighbours. Required "
                   "except for spheres.",
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
      container_length("diameter", "", "Diameter of a cylinder along z, instead of a box.", "a box",
                       &ContainerSpec::diameter);
  diameter.set = [](PackingSpec& packing, const Decoded& value) {
    packing.container.kind = ContainerSpec::Kind::cylinder;
    packing.container.diameter = value.number;
  };
  return {{{.name = "corner",
            .kind = Kind::vector,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .fallback = zero_vector("0 m"),
            .only_for = {"cubic", "body-centred", "face-centred", "hexagonal", "random"},
            .doc = "Corner with the smallest x, y and z of the first lattice cell or of the box; "
                   "for a cylinder, the centre of its floor."},
           [](PackingSpec& packing, const Decoded& value) {
             packing.container.corner = value.vector3;
           }},
          container_length("width", "depth", "Size of the box along x.",
                           "required except for a cylinder", &ContainerSpec::width),
          container_length("depth", "width", "Size of the box along y.",
                           "required except for a cylinder", &ContainerSpec::depth),
          diameter};
}

std::vector<Key<PackingSpec>> keys_of_random() {
  return {schema::height_key<PackingSpec>(
              "Height from the floor to the top. Two of count, density and height must be "
              "given."),
          schema::count_key<PackingSpec>(),
          schema::density_key<PackingSpec>(
              "shaking and compression then continue as long as they increase the density",
              "Relative density up to the top: volume of the particles divided by that of "
              "the box or cylinder. Spheres settle at 0.55 to 0.64, less in a narrow box; "
              "higher densities are refused.")};
}

Key<PackingSpec> packing_file() {
  return schema::file_of_packing_key<PackingSpec>(
      "Path relative to the folder of the scene. The columns are class, x, y, z, the "
      "rotation as a quaternion qw, qx, qy, qz, and scale if shapes differ in size "
      "from their class. Units are in the header: `x [mm]`. Lines starting with # "
      "are comments. A line `# top: 0.1 m` sets the height at which a punch rests; "
      "by default it rests on the highest particle.");
}

TableDeclaration<PackingSpec> declared_packing_in_space() {
  TableDeclaration<PackingSpec> table;
  table.info.path = "packing";
  table.info.repeated = true;
  table.info.selector = "kind";
  table.info.doc =
      "A packing of many particles. Lattice particles are numbered along x, then y, "
      "then z, particles of a random packing class by class.";
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

}  // namespace pulvis::space::language

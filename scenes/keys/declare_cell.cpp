// Declaration of the periodic cell and of its deformation by a stage.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {
namespace {

bool has_z(std::size_t part) {
  return std::string_view(tensor_part_names[part]).find('z') != std::string_view::npos;
}

// Of every component that a scene has.
void add_strain_keys(std::vector<Key<CellDriveSpec>>& keys) {
  for (std::size_t part = 0; part < tensor_parts; ++part) {
    const std::string name = tensor_part_names[part];
    const std::string doc =
        part == 0 ? "Logarithmic strain over the stage: the time integral of the rate of "
                    "deformation xx; < 0 in compression."
        : name[0] == name[1]
            ? fmt::format("As `strain_xx`, for {}.", name)
            : fmt::format("As `strain_xx`, for {}: half the engineering shear strain.", name);
    keys.push_back({{.name = "strain_" + name,
                     .kind = Kind::number,
                     .range = within(-10, 10),
                     .doc = doc,
                     .fallback_doc = "0, unless a stress is prescribed",
                     .dimension = has_z(part) ? Dimension::three : Dimension::every},
                    [part](CellDriveSpec& drive, const Decoded& value) {
                      drive.strain[part] = value.number;
                    }});
  }
}
void add_stress_keys(std::vector<Key<CellDriveSpec>>& keys) {
  for (std::size_t part = 0; part < tensor_parts; ++part)
    keys.push_back(
        {{.name = fmt::format("stress_{}", tensor_part_names[part]),
          .kind = Kind::quantity,
          .unit = "Pa",
          .range = within(-1e13, 1e13),
          .doc = part == 0 ? "Prescribed Cauchy stress instead of the strain; < 0 in compression."
                           : fmt::format("As `stress_xx`, for {}.", tensor_part_names[part]),
          .fallback_doc = "none: the strain is prescribed",
          .dimension = has_z(part) ? Dimension::three : Dimension::every},
         [part](CellDriveSpec& drive, const Decoded& value) {
           drive.stress[part] = value.number;
         }});
}

}  // namespace

const TableDeclaration<CellSpec>& cell() {
  static const TableDeclaration<CellSpec> declaration{
      {"cell",
       false,
       "",
       "A periodic cell instead of tools: what leaves on one side re-enters on the "
       "opposite side, so the powder has no walls. Stages deform it (`[stage.cell]`).",
       {"compaction"},
       true,
       Dimension::every},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .doc = "Period along the first side. A random packing in the cell must have the same "
                "width.",
         .in_3d = {.doc = "Period along x. A random packing in the cell must have the same "
                          "width."}},
        to(&CellSpec::width)},
       {{.name = "depth",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .doc = "Period along y. A random packing in the cell must have the same depth.",
         .dimension = Dimension::three},
        [](CellSpec& cell, const Decoded& value) { cell.depth = value.number; }},
       {{.name = "height",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Period along the second side.",
         .fallback_doc = "the height of the random packing",
         .in_3d = {.doc = "Period along z."}},
        to(&CellSpec::height)},
       {{.name = "corner",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .fallback = zero_vector("0 m"),
         .doc = "Lower left corner, used to draw the cell.",
         .in_3d = {.doc = "Corner with the smallest x, y and z, used to draw the cell."}},
        [](CellSpec& cell, const Decoded& value) { cell.corner = value.vector3; }},
       {{.name = "angle",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Rotation of both sides, counter-clockwise. A random packing is rotated with "
                "them, bodies placed individually are not.",
         .dimension = Dimension::two},
        to(&CellSpec::angle)}}};
  return declaration;
}

namespace {

// Of what else the lateral stresses may follow.
std::vector<Key<CellDriveSpec>> following_keys() {
  return {{{.name = "stress_ratio",
            .kind = Kind::number,
            .range = within(-100, 100),
            .doc = "Instead of strain_xx and stress_xx: stress xx follows as this ratio of the "
                   "current stress yy.",
            .fallback_doc = "none",
            .in_3d = {.doc = "Instead of strain and stress xx and yy: both stresses follow as this "
                             "ratio of the current stress zz."}},
           to(&CellDriveSpec::stress_ratio)},
          {{.name = "mean_stress",
            .kind = Kind::quantity,
            .unit = "Pa",
            .range = within(-1e13, 1e13),
            .doc = "Instead of strain_xx and stress_xx: stress xx is controlled so that the mean "
                   "of xx and yy has this value; < 0 in compression.",
            .fallback_doc = "none",
            .in_3d = {.doc = "Instead of strain and stress xx and yy: both stresses are equal, and "
                             "controlled so that the mean of xx, yy and zz has this value; < 0 in "
                             "compression."}},
           to(&CellDriveSpec::mean_stress)}};
}

std::vector<Key<CellDriveSpec>> rotation_keys() {
  return {
      {{.name = "rotation",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(-1000, 1000),
        .fallback = value_of("0 deg"),
        .doc = "Rotation over the stage, counter-clockwise: the time integral of the spin. "
               "Combined with a strain_xy of equal size and opposite sign it gives simple "
               "shear along x.",
        .dimension = Dimension::two},
       [](CellDriveSpec& drive, const Decoded& value) { drive.rotation.z() = value.number; }},
      {{.name = "rotation",
        .kind = Kind::vector,
        .unit = "rad",
        .range = within(-1000, 1000),
        .fallback = zero_vector("0 deg"),
        .doc = "Rotation over the stage about x, y and z: the time integral of the spin. "
               "Combined with a strain_zx that equals its y component it gives simple shear along "
               "x.",
        .dimension = Dimension::three},
       [](CellDriveSpec& drive, const Decoded& value) { drive.rotation = value.vector3; }}};
}

std::vector<Key<CellDriveSpec>> control_keys() {
  return {{{.name = "ramp",
            .kind = Kind::number,
            .range = above(0, 0.5),
            .doc = "Fraction of the stage over which the strain rates rise smoothly, and fall "
                   "again at the end; only with a strain or a rotation.",
            .fallback_doc = "0.1"},
           to(&CellDriveSpec::ramp)},
          {{.name = "rise",
            .kind = Kind::number,
            .range = within(0, 1),
            .doc = "Fraction of the stage over which a stress rises smoothly to its target; only "
                   "with a stress, as are `response` and `tolerance`.",
            .fallback_doc = "0.2"},
           to(&CellDriveSpec::rise)},
          {{.name = "response",
            .kind = Kind::number,
            .range = within(1e-3, 1e3),
            .doc = "Inertia of the cell divided by that of the powder in it: controls how quickly "
                   "a prescribed stress is followed.",
            .fallback_doc = "0.1"},
           to(&CellDriveSpec::response)},
          {{.name = "tolerance",
            .kind = Kind::number,
            .range = above(0, 1e9),
            .doc = "Allowed error of each stress over the last tenth of the stage, as a fraction "
                   "of the largest target stress. If it is exceeded, the run stops and reports the "
                   "stresses reached.",
            .fallback_doc = "0.05"},
           to(&CellDriveSpec::tolerance)}};
}

std::vector<Key<CellDriveSpec>> drive_keys() {
  std::vector<Key<CellDriveSpec>> keys;
  add_strain_keys(keys);
  add_stress_keys(keys);
  for (const auto& more : {following_keys(), rotation_keys(), control_keys()})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

}  // namespace

const TableDeclaration<CellDriveSpec>& cell_drive() {
  static const TableDeclaration<CellDriveSpec> declaration{
      {"stage.cell", false, "",
       "Deformation of the periodic cell during the preceding stage: each component "
       "is prescribed as a strain or as a stress. Without this table the cell keeps "
       "its shape. In a die of planes with normals along the axes, one on each side, this table "
       "moves the planes, without shear or rotation and symmetrically on opposite "
       "sides.",
       compaction_only, true, Dimension::every},
      drive_keys()};
  return declaration;
}

}  // namespace pulvis::schema

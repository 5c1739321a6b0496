// Declaration of the periodic cell and of its deformation by a stage.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {
namespace {

Key<CellDriveSpec> strain_key(const char* name, const char* doc,
                              std::optional<double> CellDriveSpec::*member) {
  return {{.name = name,
           .kind = Kind::number,
           .range = within(-10, 10),
           .doc = doc,
           .fallback_doc = "0, unless a stress is prescribed"},
          to(member)};
}
Key<CellDriveSpec> stress_key(const char* name, const char* doc,
                              std::optional<double> CellDriveSpec::*member) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "Pa",
           .range = within(-1e13, 1e13),
           .doc = doc,
           .fallback_doc = "none: the strain is prescribed"},
          to(member)};
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
       Dimension::two},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .doc = "Period along the first side. A random packing in the cell must have the same "
                "width."},
        to(&CellSpec::width)},
       {{.name = "height",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Period along the second side.",
         .fallback_doc = "the height of the random packing"},
        to(&CellSpec::height)},
       {{.name = "corner",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .fallback = zero_vector("0 m"),
         .doc = "Lower left corner, used to draw the cell."},
        to(&CellSpec::corner)},
       {{.name = "angle",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Rotation of both sides, counter-clockwise. A random packing is rotated with "
                "them, bodies placed individually are not."},
        to(&CellSpec::angle)}}};
  return declaration;
}

const TableDeclaration<CellDriveSpec>& cell_drive() {
  static const TableDeclaration<CellDriveSpec> declaration{
      {"stage.cell", false, "",
       "Deformation of the periodic cell during the preceding stage: each component "
       "is prescribed as a strain or as a stress. Without this table the cell keeps "
       "its shape. In a die of four planes with normals along x and y, this table "
       "moves the planes, without shear or rotation and symmetrically on opposite "
       "sides.",
       compaction_only, true, Dimension::two},
      {strain_key("strain_xx",
                  "Logarithmic strain over the stage: the time integral of the rate of "
                  "deformation xx; < 0 in compression.",
                  &CellDriveSpec::strain_xx),
       strain_key("strain_yy", "As `strain_xx`, for yy.", &CellDriveSpec::strain_yy),
       strain_key("strain_xy", "As `strain_xx`, for xy: half the engineering shear strain.",
                  &CellDriveSpec::strain_xy),
       stress_key("stress_xx",
                  "Prescribed Cauchy stress instead of the strain; < 0 in compression.",
                  &CellDriveSpec::stress_xx),
       stress_key("stress_yy", "As `stress_xx`, for yy.", &CellDriveSpec::stress_yy),
       stress_key("stress_xy", "As `stress_xx`, for xy.", &CellDriveSpec::stress_xy),
       {{.name = "stress_ratio",
         .kind = Kind::number,
         .range = within(-100, 100),
         .doc = "Instead of strain_xx and stress_xx: stress xx follows as this ratio of the "
                "current stress yy.",
         .fallback_doc = "none"},
        to(&CellDriveSpec::stress_ratio)},
       {{.name = "mean_stress",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(-1e13, 1e13),
         .doc = "Instead of strain_xx and stress_xx: stress xx is controlled so that the mean "
                "of xx and yy has this value; < 0 in compression.",
         .fallback_doc = "none"},
        to(&CellDriveSpec::mean_stress)},
       {{.name = "rotation",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Rotation over the stage, counter-clockwise: the time integral of the spin. "
                "Combined with a strain_xy of equal size and opposite sign it gives simple "
                "shear along x."},
        to(&CellDriveSpec::rotation)},
       {{.name = "ramp",
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
         .doc = "Allowed error of each stress over the last tenth of the stage, as a fraction of "
                "the largest target stress. If it is exceeded, the run stops and reports the "
                "stresses reached.",
         .fallback_doc = "0.05"},
        to(&CellDriveSpec::tolerance)}}};
  return declaration;
}

}  // namespace pulvis::schema

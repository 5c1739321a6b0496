// Declaration of the periodic cell and of how a stage deforms it.
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
           .fallback_doc = "0, where no stress is asked for"},
          to(member)};
}
Key<CellDriveSpec> stress_key(const char* name, const char* doc,
                              std::optional<double> CellDriveSpec::*member) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "Pa",
           .range = within(-1e13, 1e13),
           .doc = doc,
           .fallback_doc = "none, a strain drives it"},
          to(member)};
}

}  // namespace

const TableDeclaration<CellSpec>& cell() {
  static const TableDeclaration<CellSpec> declaration{
      {"cell",
       false,
       "",
       "A periodic cell instead of tools: what leaves it on one side comes in on the other, so the "
       "powder has no walls. Stages deform it (`[stage.cell]`).",
       {"compaction"},
       true},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .required = true,
         .doc = "Period along the first side. A random packing in the cell has the same width."},
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
         .fallback = pair_of("0 m", "0 m"),
         .doc = "Lower left corner: where pictures show the cell."},
        to(&CellSpec::corner)},
       {{.name = "angle",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Turn of both sides, counter-clockwise. A random packing is turned with them, "
                "bodies that "
                "are placed by hand are not."},
        to(&CellSpec::angle)}}};
  return declaration;
}

const TableDeclaration<CellDriveSpec>& cell_drive() {
  static const TableDeclaration<CellDriveSpec> declaration{
      {"stage.cell", false, "",
       "How the periodic cell deforms during the stage above it: each component by a strain, or "
       "by the stress that it is to bear. Without this table the cell keeps its shape. In a die of "
       "four planes with normals along x and y: how these move, without shear and rotation, both "
       "sides alike.",
       compaction_only, true},
      {strain_key("strain_xx",
                  "Logarithmic strain over the stage: the rate of deformation xx, integrated; < 0 "
                  "in compression.",
                  &CellDriveSpec::strain_xx),
       strain_key("strain_yy", "The same, yy.", &CellDriveSpec::strain_yy),
       strain_key("strain_xy", "The same, xy: half of the engineering shear.",
                  &CellDriveSpec::strain_xy),
       stress_key("stress_xx", "Instead of the strain: Cauchy stress; < 0 in compression.",
                  &CellDriveSpec::stress_xx),
       stress_key("stress_yy", "The same, yy.", &CellDriveSpec::stress_yy),
       stress_key("stress_xy", "The same, xy.", &CellDriveSpec::stress_xy),
       {{.name = "stress_ratio",
         .kind = Kind::number,
         .range = within(-100, 100),
         .doc = "Instead of strain_xx and stress_xx: the stress xx is kept at this share of the "
                "stress yy of the moment.",
         .fallback_doc = "none"},
        to(&CellDriveSpec::stress_ratio)},
       {{.name = "mean_stress",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(-1e13, 1e13),
         .doc = "Instead of strain_xx and stress_xx: the stress xx is kept so that the mean of xx "
                "and yy is this; < 0 in compression.",
         .fallback_doc = "none"},
        to(&CellDriveSpec::mean_stress)},
       {{.name = "rotation",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Turn over the stage, counter-clockwise: the spin, integrated. With strain_xy of "
                "the same size the other way: simple shear along x."},
        to(&CellDriveSpec::rotation)},
       {{.name = "ramp",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .doc =
             "Share of the stage in which the rates of strain rise smoothly, and fall again; only "
             "with a strain or a rotation.",
         .fallback_doc = "0.1"},
        to(&CellDriveSpec::ramp)},
       {{.name = "rise",
         .kind = Kind::number,
         .range = within(0, 1),
         .doc =
             "Share of the stage in which a stress rises smoothly to what is asked for; only with "
             "a stress, as `response` and `tolerance`.",
         .fallback_doc = "0.2"},
        to(&CellDriveSpec::rise)},
       {{.name = "response",
         .kind = Kind::number,
         .range = within(1e-3, 1e3),
         .doc = "Inertia of the cell over that of the powder in it: how fast a stress is followed.",
         .fallback_doc = "0.1"},
        to(&CellDriveSpec::response)},
       {{.name = "tolerance",
         .kind = Kind::number,
         .range = above(0, 1e9),
         .doc = "Share of the largest stress asked for by which each may be off at the end of the "
                "stage; otherwise the run stops and says what was reached.",
         .fallback_doc = "0.05"},
        to(&CellDriveSpec::tolerance)}}};
  return declaration;
}

}  // namespace pulvis::schema

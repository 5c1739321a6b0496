// Columns that always go together, as bundles of accesses (engine/bundle.hpp), for systems in several directories.
// Mode: Read or Write.
#pragma once

#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/shaped_bodies.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"

namespace pulvis {

// ---- bodies -------------------------------------------------------------------------------------
struct Elasticity {
  Read<ShearModulus> shear;
  Read<BulkModulus> bulk;
};
struct Material {
  Read<Density> density;
  Elasticity elastic;
};
struct BulkDamping {
  Read<MassDamping> mass;
  Read<StiffnessDamping> stiffness;
};
template <class D>
struct Motion {  // of the nodes
  Read<Position<D>> position;
  Read<Velocity<D>> velocity;
};
// Nodal forces. Contact forces are kept separately, and exist only if the scene has contact.
template <template <class> class Mode, class D>
struct NodalForces {
  Mode<InternalForce<D>> internal;
  Optional<Read<ContactForce<D>>> contact;
};
// F: the formulation of the elements (components/formulation.hpp, components/space/formulation.hpp).
template <template <class> class Mode, class F>
struct ElementStress {
  Mode<DeviatoricStress<typename F::Dimension, F::points>> deviator;
  Mode<MeanStress<F::volumes>> mean;
};
// Only for one-point elements: the stress of the hourglass modes.
template <template <class> class Mode>
struct BendingModes {
  Mode<HourglassStress> stress;
  Mode<MinCorner> min_corner;
};
// For each particle, its element that is closest to inversion.
template <template <class> class Mode>
struct WorstJacobian {
  Mode<MinJacobian> value;
  Mode<WorstElement> element;
};

// ---- contact ------------------------------------------------------------------------------------
struct ContactCurves {
  Read<CurvePosition> position;
  Optional<Read<CurveVelocity>> velocity;          // only with friction or damping
  Optional<Read<SurfaceHardness<TwoD>>> hardness;  // only where surfaces indent
};
// The surfaces of the tools; polylines need more than a normal.
struct ToolSurfaces {
  Read<ToolNormal> normal;
  Read<ToolPosition> position;
  Optional<Read<ToolShapes>> shapes;

  bool is(int tool, ToolShapes::Kind kind) const {
    return shapes ? (*shapes)->is(tool, kind) : kind == ToolShapes::Kind::plane;
  }
};
// Output of the narrow phases for systems that look at touching rows.
template <class At>
struct TouchingRows {
  Read<ContactPair<At>> pair;
  Read<ContactTouches<At>> touches;
  Read<PointForce<At>> force;
};
// In a periodic cell: the periodic image of the other particle that a row refers to.
template <class D>
struct CellImages {
  using At = typename D::Contact;
  Read<ContactImage<At>> image;
  Read<PeriodicCell<D>> cell;
  ImageIn<D> of(Row<At> row) const {
    ImageIn<D> n;
    for (std::size_t k = 0; k < D::axes; ++k) n[k] = image(row, static_cast<int>(k));
    return n;
  }
  typename D::Point shift(Row<At> row) const { return cell->vectors * of(row); }  // m
  typename D::Point velocity(Row<At> row) const { return cell->rate * of(row); }  // m/s
};
struct TouchingPairs {
  TouchingRows<Contact> rows;
  Read<ClosestPoint> closest;
  Optional<CellImages<TwoD>> images;

  // Relative to the other particle itself instead of its image.
  Point from_image(Row<Contact> row, const Point& at) const {
    if (!images) return at;
    const Point shift = images->shift(row);
    return {at[0] - shift[0], at[1] - shift[1]};
  }
};
struct TouchingTools {
  TouchingRows<ToolContact> rows;
  ToolSurfaces surfaces;
  Optional<Read<SurfaceRange>> range;  // only with polylines
};

}  // namespace pulvis

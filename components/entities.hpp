// The entity types that arrays have rows for. `laned`: rows are stored in slots of eight particles of one chunk.
// `by_chunk`: the rows of a chunk are contiguous, so a chunk system may write its own.
#pragma once

#include "engine/component.hpp"

namespace pulvis {

struct Node {  // of a particle's mesh; the nodes of the outline come first
  static constexpr const char* name = "node";
  static constexpr bool laned = true, by_chunk = true;
};
struct BoundaryNode {  // the same nodes, outline only
  static constexpr const char* name = "boundary";
  static constexpr bool laned = true, by_chunk = true;
};
struct Element {  // four-node quad; its integration points are components of a row
  static constexpr const char* name = "element";
  static constexpr bool laned = true, by_chunk = true;
};
struct Particle {  // one slot per chunk
  static constexpr const char* name = "particle";
  static constexpr bool laned = true, by_chunk = true;
};
struct ControlPoint {  // of the contact curves, stored by particle
  static constexpr const char* name = "curve";
  static constexpr bool laned = false, by_chunk = true;
};
// Candidates are of two kinds, between particles and with tools, whose sums are kept apart alike in both dimensions.
struct Contact {  // (edge of one particle, other particle)
  using Kind = Contact;
  static constexpr int axes = 2, points = 4;  // Gauss points per row
  static constexpr const char *name = "contact", *blocks_name = "contact_blocks";
  static constexpr bool laned = false, by_chunk = false;
  static constexpr int rows_of_a_block = 128;
};
struct ToolContact {  // (edge of a particle, tool)
  using Kind = ToolContact;
  static constexpr int axes = 2, points = 4;
  static constexpr const char *name = "tool_contact", *blocks_name = "tool_contact_blocks";
  static constexpr bool laned = false, by_chunk = false;
  static constexpr int rows_of_a_block = 128;
};
struct SurfacePoint {  // Bezier points of a particle's surface in three dimensions
  static constexpr const char* name = "surface_point";
  static constexpr bool laned = true, by_chunk = true;
};
struct ParticleSurface {  // the same points, stored by particle
  static constexpr const char* name = "particle_surface";
  static constexpr bool laned = false, by_chunk = true;
};
struct WholeSurface {  // of a particle, stored by particle
  static constexpr const char* name = "whole_surface";
  static constexpr bool laned = false, by_chunk = true;
};
struct SurfaceFace {  // four-sided patches of these surfaces, stored by particle
  static constexpr const char* name = "surface_face";
  static constexpr bool laned = false, by_chunk = true;
};
struct FaceContact {  // (face of one particle, other particle)
  using Kind = Contact;
  static constexpr int axes = 3, points = 16;
  static constexpr const char* name = "face_contact";
  static constexpr bool laned = false, by_chunk = false;
};
struct FaceToolContact {  // (face of a particle, tool)
  using Kind = ToolContact;
  static constexpr int axes = 3, points = 16;
  static constexpr const char *name = "face_tool_contact",
                              *blocks_name = "face_tool_contact_blocks";
  static constexpr bool laned = false, by_chunk = false;
  static constexpr int rows_of_a_block = 32;
};
inline constexpr int tool_axes = 3;  // tools are three-dimensional in two dimensions too
struct Tool {
  static constexpr const char* name = "tool";
  static constexpr bool laned = false, by_chunk = false;
};

}  // namespace pulvis

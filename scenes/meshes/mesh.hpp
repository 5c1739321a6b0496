// Meshes of particle outlines by quads, and the smooth contact curve of each outline.
#pragma once

#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The undeformed shape of a particle class: mesh, Gauss points, masses, contact curve. `phase` turns the
// mesh of a disc or ring inside its outline (rad).
Shape make_shape(const ParticleSpec& particle, double phase = 0);

// How good the worst element is: least sine of its corner angles, 1 for a rectangle.
double min_corner_sine(const Shape& shape);

double shortest_edge(const Shape& shape);  // m, of all elements, undeformed

}  // namespace pulvis

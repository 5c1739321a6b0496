// Quad meshes of particle outlines, and the smooth contact curve of each outline.
#pragma once

#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Undeformed shape of a particle class: mesh, Gauss points, masses, contact curve. `phase` rotates the
// mesh of a disc or ring inside its outline (rad).
Shape make_shape(const ParticleSpec& particle, double phase = 0);

// Quality of the worst element: smallest sine of its corner angles, 1 for a rectangle.
double min_corner_sine(const Shape& shape);

double shortest_edge(const Shape& shape);  // m, over all elements, undeformed

}  // namespace pulvis

// A bare loop over one-point quads as a baseline for the kernels: plain data, so that only limit_loop.cpp is compiled
// for AVX2.
//
// Method   small-increment J2: Jaumann rate, radial return, linear hardening; elastic hourglass stress of Flanagan &
//          Belytschko (1981); leapfrog. Four particles of one mesh in the lanes of a register
// Lacks    exact finite strain, plastic bending, other material laws, contact
#pragma once

namespace pulvis::bench {

using Four [[gnu::vector_size(32)]] = double;  // one particle per lane

struct alignas(32) LimitNode {
  Four x, y, u, v;  // m, m/s
};
struct alignas(32) LimitElement {
  Four sxx, syy, szz, sxy;  // Pa
  Four eps;                 // accumulated plastic strain
  Four qx, qy;              // hourglass forces, N/m
};
struct alignas(32) LimitForce {
  Four x, y;
};
struct LimitQuad {
  unsigned short node[4];  // counter-clockwise
};

struct LimitMesh {
  const LimitQuad* quads;
  const double* inv_mass;  // by node, m/kg
  int elements, nodes;
};
struct LimitMaterial {
  double lambda, two_mu, yield_stress, hardening;  // Pa
  double hourglass;                                // Pa, multiplies a rate times the step
  double dt;                                       // s
};

// One step of four particles. `force` is zero before and after.
void limit_step(LimitNode* nodes, LimitElement* elements, LimitForce* force, const LimitMesh& mesh,
                const LimitMaterial& m);

}  // namespace pulvis::bench

// A bare loop over one-point quads, to measure the kernels against: plain data, so that limit_loop.cpp alone is compiled
// for AVX2.
//
// Method   small-increment J2: Jaumann rate, radial return, linear hardening; elastic hourglass stress of Flanagan &
//          Belytschko (1981); leapfrog. Four particles of one mesh in the lanes of a register
// Lacks    the exactness of finite strain, plastic bending, other laws, any contact
#pragma once

namespace pulvis::bench {

using Four [[gnu::vector_size(32)]] = double;  // one particle a lane

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
  double hourglass;                                // Pa, of a rate times the step
  double dt;                                       // s
};

// One step of four particles. `force` is zero before and after.
void limit_step(LimitNode* nodes, LimitElement* elements, LimitForce* force, const LimitMesh& mesh,
                const LimitMaterial& m);

}  // namespace pulvis::bench

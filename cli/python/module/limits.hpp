// What Python may set in a running simulation: the ranges that the declared keys of the scene have.
#pragma once

#include <string>

#include "scenes/language/schema.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::python {

const schema::KeyInfo& declared_key(const Scene& scene, const std::string& table,
                                    const std::string& key);

// Columns that may be modified between two steps, and the key that sets their values in a scene. Nothing caches them:
// stored energies, contacts and the stable time step are recomputed from them, or do not depend on them.
struct WritableColumn {
  const char* name;
  const char* table;
  const char* key;
};
inline constexpr WritableColumn writable_columns[] = {
    {"node.velocity", "body", "velocity"},
    {"particle.yield_stress", "material", "yield_stress"},
    {"particle.hardening_modulus", "material", "hardening_modulus"},
    {"particle.mass_damping", "material.damping", "mass_proportional"}};

// nullptr if it is none of them.
const WritableColumn* writable_column(const std::string& name);

// Of one number of the column, for particles of this material: its declared range, and what the checks of the scene
// leave of it.
schema::KeyInfo limits_of(const WritableColumn& column, const Scene& scene, int material);

// "nan m/s is not finite, allowed: a quantity in m/s, >= -100000 and <= 100000"; empty if it is allowed.
std::string fault_of(double value, const schema::KeyInfo& limits);

}  // namespace pulvis::python

// The tables of reduce.toml that convert an AFM's volts to friction, and checks across them.
#pragma once

#include <string>
#include <vector>

#include "cli/laboratory/volts/volts_spec.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis::volts {

const schema::TableDeclaration<AfmSpec>& declared_afm();
const schema::TableDeclaration<ForceCurvesSpec>& declared_force_curves();
const schema::TableDeclaration<LeverSpec>& declared_lever();
const schema::TableDeclaration<CrosstalkSpec>& declared_crosstalk();
const schema::TableDeclaration<TestProbeSpec>& declared_test_probe();

struct Fault {
  std::string path;  // of the key
  std::string what;  // ..., allowed: ...
};

// `has_wedge`: there are loops on slopes.
std::vector<Fault> faults_of(const VoltsSpec& spec, bool has_wedge);

}  // namespace pulvis::volts

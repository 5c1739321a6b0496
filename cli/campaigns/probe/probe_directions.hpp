// The directions in which a state is probed.
#pragma once

#include <string>
#include <vector>

#include "cli/campaigns/probe/mandel.hpp"
#include "cli/campaigns/probe/probe_spec.hpp"

namespace pulvis {

struct ProbeDirection {
  enum class Set {
    axial,       // in the plane of the axis of pressing (AxialPlane)
    deviatoric,  // at constant trace, in three dimensions only
    shear,       // one component of shear
    given        // by the probe file
  };
  std::string name;  // "direction=225", "lode=60", "shear", "shear_yz", or as given
  Set set = Set::axial;
  double angle = 0;               // rad, of the first two sets
  Mandel unit = Mandel::Unit(0);  // of the strain, or of the change of stress
};

std::vector<ProbeDirection> directions_of(const ProbeSpec& spec, bool in_space);

inline Axis axis_of(bool in_space) { return in_space ? Axis::z : Axis::y; }

// Words for tables: "axial".
const char* name_of(ProbeDirection::Set set);

}  // namespace pulvis

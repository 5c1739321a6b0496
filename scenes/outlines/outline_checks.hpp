// Errors in an outline defined by user-supplied numbers: reasons and bounds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct OutlineFault {
  std::string key;      // key of the particle: "corners"
  std::string message;  // what is wrong, what is allowed
};

std::vector<OutlineFault> faults_of(const EllipseOutline& outline);
std::vector<OutlineFault> faults_of(const SuperellipseOutline& outline);
std::vector<OutlineFault> faults_of(const PolygonOutline& outline);
std::vector<OutlineFault> faults_of(const PointsOutline& outline);
std::vector<OutlineFault> faults_of(const FourierOutline& outline);

}  // namespace pulvis

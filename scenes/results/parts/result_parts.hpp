// Results that depend on the dimension: the mesh, and the surfaces of the tools for pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/files/record.hpp"

namespace pulvis {

class ResultParts {
 public:
  ResultParts() = default;
  ResultParts(const ResultParts&) = delete;
  ResultParts& operator=(const ResultParts&) = delete;
  virtual ~ResultParts() = default;

  virtual RunMesh mesh() const = 0;
  // A field of the frames: points of the tools' surfaces. None: there are no tools.
  virtual std::optional<FieldInfo> tool_field() const = 0;
  virtual std::vector<double> tool_points() const = 0;

  virtual double powder() const = 0;  // of all particles, undeformed: m^2, in three dimensions m^3
  virtual double volume() const = 0;  // m^3, of the same
  virtual std::int64_t elements() const = 0;
};

}  // namespace pulvis

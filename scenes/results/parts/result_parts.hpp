// Results that depend on the dimension: mesh and fields, tools and the space between them, momentum.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/files/record.hpp"

namespace pulvis {

// Energies of the whole scene at t_n, J. `balance` is the remainder of the others: 0 in a perfect run.
struct Energies {
  double kinetic = 0, elastic = 0, plastic = 0, hourglass = 0, contact = 0;
  double friction = 0, damping = 0, bulk_damping = 0, bonds = 0, fracture = 0;
  double external = 0, balance = 0;
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(kinetic, elastic, plastic, hourglass, contact, friction, damping, bulk_damping, bonds,
          fracture, external, balance);
  }
  double internal() const { return elastic + plastic + hourglass; }
};

class ResultParts {
 public:
  using Fields = std::vector<std::vector<double>>;

  ResultParts() = default;
  ResultParts(const ResultParts&) = delete;
  ResultParts& operator=(const ResultParts&) = delete;
  virtual ~ResultParts() = default;

  virtual RunMesh mesh() const = 0;
  // The fields of every run; those of its tools come last.
  virtual std::vector<FieldInfo> fields() const = 0;
  virtual std::vector<FieldInfo> tool_fields() const = 0;
  // Fields other than those of the mesh (mesh_values).
  virtual void append_frame(Fields& fields) const = 0;
  virtual void append_tool_frame(Fields& fields) const = 0;

  // Of the history, in order: tools and the space around the powder; contacts; observed quantities.
  virtual void append_tools(const Energies& energies, std::vector<double>& row) const = 0;
  virtual void append_contacts(std::vector<double>& row) const = 0;
  virtual void append_observed(std::vector<double>& row) const = 0;

  // Linear, then angular about the origin.
  virtual std::vector<double> momentum() const = 0;
  virtual double volume() const = 0;  // m^3, of all particles, undeformed
  virtual std::int64_t elements() const = 0;
};

}  // namespace pulvis

// The fields of a run that the report shows: one number per cell, from the cell, node and particle fields of run.h5.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/report/report_encoding.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

constexpr Range nothing_yet{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
void widen(Range& range, double value);  // by a finite value

struct CellField {
  std::string dataset, label, unit, meaning;
  std::size_t component = 0, stored = 1, used = 1;
  bool speed = false;        // computed from the nodal velocities
  bool of_particle = false;  // one number per particle, shown by all of its cells
  Range range = nothing_yet;
};

// Which fields of a frame are shown.
struct FieldChoice {
  bool tensors = true;    // those with several components, each separately
  bool particles = true;  // all particle fields, not only damage and fragments
};
std::vector<CellField> cell_fields(const hdf5::File& file, const std::string& frame,
                                   const FieldChoice& choice);

struct FieldMesh {
  std::span<const std::int32_t> cells;  // `corners` nodes each
  std::size_t corners = 4;
  std::span<const std::int32_t> cell_particle;
};
std::vector<double> cell_values(const hdf5::File& file, const std::string& frame,
                                const CellField& field, const FieldMesh& mesh);

// A field that has no value in any frame is not shown.
void leave_out_empty(std::vector<CellField>& fields);

// As stored in the head; `levels`: of its quantised numbers.
nlohmann::ordered_json described(const CellField& field, std::size_t levels);

}  // namespace pulvis

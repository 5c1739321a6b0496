// The fields of a run that the report shows: one number a cell, from the fields of cells, nodes and particles of run.h5.
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
void widen(Range& range, double value);  // by a finite one

struct CellField {
  std::string dataset, label, unit, meaning;
  std::size_t component = 0, stored = 1, used = 1;
  bool speed = false;        // made from the velocities of the nodes
  bool of_particle = false;  // one number a particle, which all of its cells show
  Range range = nothing_yet;
};

// Which fields of a frame are shown.
struct FieldChoice {
  bool tensors = true;    // those of more than one component, each by itself
  bool particles = true;  // of particles all, not only damage and fragments
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

// As the head has it; `levels`: of its numbers.
nlohmann::ordered_json described(const CellField& field, std::size_t levels);

}  // namespace pulvis

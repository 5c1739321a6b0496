// run.xdmf: tells ParaView and meshio how to read the frames of run.h5 as one moving mesh, and the outlines of the
// tools (in space their surfaces) as another.
//
// One Uniform grid per frame, each with its own geometry, and every item a whole dataset: readers
// differ in their support of hyperslabs. With new frames the file is replaced as a whole (written to a temporary
// file and renamed), so that nobody ever reads a partial file. Particle fields are omitted:
// the format supports only nodes and cells.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/files/record.hpp"

namespace pulvis {

class Xdmf {
 public:
  // `heavy` is the name of the HDF5 file relative to the folder of `path`.
  Xdmf(std::filesystem::path path, std::string heavy, const RunMesh& mesh,
       const std::vector<FieldInfo>& fields);
  void add(double time, const std::string& group);  // group: "/frames/000000"
  void write();                                     // the frames so far
  void finish() const;                              // no more frames

 private:
  std::string text() const;
  std::string grid(double time, const std::string& group) const;
  std::string tool_grid(double time, const std::string& group) const;
  std::string whole_numbers(const std::string& name, const std::string& dataset,
                            std::uint64_t count) const;
  std::string item(const std::string& dataset, const std::string& number, std::uint64_t rows,
                   int columns) const;
  std::string attribute(const FieldInfo& field, const std::string& group) const;

  std::filesystem::path path_;
  std::string heavy_;
  std::uint64_t nodes_, cells_;
  bool in_space_;
  std::uint64_t tool_pieces_;  // lines; in space, four-corner surfaces
  std::uint64_t tool_points_;
  std::vector<FieldInfo> fields_;
  std::vector<std::string> tags_;   // of the particles, one per cell
  std::string grids_, tool_grids_;  // XML text of the frames so far
  bool is_noted_ = false;
};

bool is_of_mesh(const FieldInfo& field);  // constant number of rows, and shown in XDMF

// The components a field is stored with: plane vectors get a third one, as XDMF has only those.
int stored_components(const FieldInfo& field);
std::vector<double> with_zero_third(std::span<const double> plane);

}  // namespace pulvis

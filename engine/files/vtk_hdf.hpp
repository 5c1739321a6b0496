// run.vtkhdf and tools.vtkhdf: the frames of run.h5 as VTK and ParaView read them, the powder and the tools.
//
// Their datasets are views ("virtual datasets") of those of run.h5, which they find in their own folder: nothing is stored
// twice. Positions and vectors in the plane get a third component of zero, stresses in the plane two more: the six that VTK
// expects (xx yy zz xy yz zx). Format: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html#vtkhdf-file-format
//
// Rows of the newest frame come first. Readers of a series follow the offsets in Steps; VTK 9.1 and 9.2, which know of no
// series, read from the first row on, and thus show the newest frame.
//
// Like run.xdmf, the files are replaced as a whole with new frames, after run.h5 holds them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "engine/files/record.hpp"

namespace pulvis {

struct VtkGrid {
  std::filesystem::path path;
  std::string points;  // name in a frame
  std::uint64_t number_of_points = 0;
  std::string cells;  // dataset with the points of each cell
  hdf5::Shape corners;
  std::uint8_t cell_type = 0;                                  // VTK's number
  std::vector<FieldInfo> fields;                               // of the frames
  std::vector<std::pair<std::string, std::string>> constants;  // of cells: name, dataset
};

class VtkHdf {
 public:
  // `heavy` is the name of the HDF5 file in `folder`.
  VtkHdf(const std::filesystem::path& folder, std::string heavy, const RunMesh& mesh,
         const std::vector<FieldInfo>& fields);
  void add(double time, const std::string& group);  // group: "/frames/000000"
  void write() const;                               // the frames so far

 private:
  void write(const VtkGrid& grid) const;
  void write_mesh(hdf5::File& file, const VtkGrid& grid) const;
  void write_fields(hdf5::File& file, const VtkGrid& grid) const;
  void write_steps(hdf5::File& file, const VtkGrid& grid) const;
  void view(hdf5::File& file, const std::string& dataset, const std::string& name,
            const hdf5::Shape& shape) const;
  std::vector<std::int64_t> rows_of_frames(std::uint64_t rows) const;

  std::string heavy_;
  std::uint64_t dimension_;
  std::vector<VtkGrid> grids_;
  std::vector<double> times_;
  std::vector<std::string> groups_;
};

}  // namespace pulvis

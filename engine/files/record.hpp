// What a run tells the recorder about itself: names, units, labels and meanings of its results, the
// mesh they are defined on, and where they came from.
//
// A label is what axes and tables show: words, and the symbol, if there is one, as mathtext: "pressure $p$".
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/files/shared_file.hpp"

namespace pulvis {

struct SeriesInfo {  // one series of the history: one number per sample
  std::string name;  // slashes create groups: "tool/top/force_y"
  std::string unit;  // SI, "-" if dimensionless
  std::string label;
  std::string meaning;  // one line for the reader
  bool whole = false;   // integers, and stored as such: only in tables
};

// Spacing of the pixels of an image, m; 0: no physical size.
struct PixelSpacing {
  double along = 0, across = 0;  // along a line; from line to line
};

// A table whose rows are added as events occur: column "x" of table "cracks" is /cracks/x of run.h5.
struct TableInfo {
  std::string name;
  std::vector<SeriesInfo> columns;
};

// The sampling variable: the first column of history.csv; /history/time of run.h5 has its unit.
inline const SeriesInfo simulated_time{"time", "s", "time $t$", "simulated time"};

// `list`: separate rows, whose number may change over time.
enum class FieldPlace { node, cell, particle, list };

struct FieldInfo {  // one field of the frames: `components` numbers per place
  std::string name;
  std::string unit;
  std::string label;
  std::string meaning;
  FieldPlace place = FieldPlace::cell;
  int components = 1;
  bool whole = false;  // integers, and stored as such
};

// The values of a frame's fields, requested one after the other: the components of a place are contiguous.
using FrameValues = std::function<std::vector<double>(std::size_t field)>;

// Where a field's values are in a file: rows of `stored` numbers, of which the last ones are zero if there are more than
// `components`.
struct FieldRoom {
  FileRoom at;
  FieldPlace place = FieldPlace::cell;
  int components = 1, stored = 1;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(at, place, components, stored);
  }
};
// Fields of the mesh that several processes write: each writes the rows of its own particles into the file.
struct FieldWriters {
  std::function<bool(std::size_t field)> takes;
  std::function<void(std::size_t field, const FieldRoom&)> write;
  std::function<void()> flush;  // what was written, to disk
};

// A constant integer per particle: /particles/<name>. If the numbers are positions in a list
// of names, its attribute `names` holds that list, one per line.
struct ParticleTag {
  std::string name, label, meaning;
  std::vector<std::int32_t> values;  // [particles]
  std::vector<std::string> names;
};

inline bool is_named(const ParticleTag& tag) { return !tag.names.empty(); }

// Outlines of the tools, for visualisation: their end points are rows of the field `tools/outline` in each frame.
struct ToolLines {
  std::vector<std::string> names;  // of the tools
  std::vector<std::int32_t> ends;  // [lines * 2]
  std::vector<std::int32_t> tool;  // [lines], position in `names`
  std::uint64_t points() const {   // the lines of each tool form a closed loop
    return tool.size();
  }
};

// Tool surfaces in space, for visualisation: four corners per piece, rows of field `tools/outline` in each frame;
// a triangle repeats its last corner. Corners are counter-clockwise seen from the powder.
struct ToolFaces {
  std::vector<std::string> names;     // of the tools
  std::vector<std::string> kinds;     // of the tools: plane, die, punch, stl
  std::vector<std::int32_t> corners;  // [pieces * 4]
  std::vector<std::int32_t> tool;     // [pieces], position in `names`
  std::uint64_t points = 0;           // rows of `tools/outline`
};

struct RunMesh {                            // constant during the run
  std::vector<std::int32_t> quads;          // [cells * 4], node numbers, counter-clockwise
  std::vector<std::int32_t> cell_particle;  // [cells]
  std::vector<std::int32_t> node_particle;  // [nodes]
  std::vector<double> reference;  // [nodes * dimension], m, positions before the first step
  std::vector<std::int32_t> hexahedra = {};  // [cells * 8] instead of quads: a mesh in space
  std::vector<ParticleTag> tags = {};
  ToolLines tools = {};
  ToolFaces tool_faces = {};  // for a mesh in space, instead of lines
  int dimension() const { return hexahedra.empty() ? 2 : 3; }
};

struct RunAttributes {
  std::string version, commit, title, scene_hash;
  std::uint64_t seed = 0;
  int threads = 1;
};

}  // namespace pulvis

// What a run tells the recorder about itself: the names, units and meanings of its results, the
// mesh they live on, and where they came from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pulvis {

struct SeriesInfo {     // one series of the history: a number a sample
  std::string name;     // slashes make groups: "tool/top/force_y"
  std::string unit;     // SI, "-" where there is none
  std::string meaning;  // a line for the reader
  bool whole = false;   // whole numbers, and stored as such: of tables only
};

// How far the pixels of a picture are apart, m; 0: they have no size.
struct PixelSpacing {
  double along = 0, across = 0;  // of a line; from line to line
};

// Rows of their own, which come when they come: column "x" of table "cracks" is /cracks/x of run.h5.
struct TableInfo {
  std::string name;
  std::vector<SeriesInfo> columns;
};

// What the samples follow: the first column of history.csv; /history/time of run.h5 has its unit.
inline const SeriesInfo simulated_time{"time", "s", "simulated time"};

// `list`: rows of their own, as many as there are at that time.
enum class FieldPlace { node, cell, particle, list };

struct FieldInfo {  // one field of the frames: `components` numbers a place
  std::string name;
  std::string unit;
  std::string meaning;
  FieldPlace place = FieldPlace::cell;
  int components = 1;
  bool whole = false;  // whole numbers, and stored as such
};

// The values of a frame's fields, asked for one after the other: the components of a place together.
using FrameValues = std::function<std::vector<double>(std::size_t field)>;

// A whole number of every particle that does not change: /particles/<name>. Where numbers are positions in a list
// of names, its attribute `names` has that list, one a line.
struct ParticleTag {
  std::string name, meaning;
  std::vector<std::int32_t> values;  // [particles]
  std::vector<std::string> names;
};

inline bool is_named(const ParticleTag& tag) { return !tag.names.empty(); }

// Lines around the tools, for pictures: rows of the field `tools/outline` in each frame are their ends.
struct ToolLines {
  std::vector<std::string> names;  // of the tools
  std::vector<std::int32_t> ends;  // [lines * 2]
  std::vector<std::int32_t> tool;  // [lines], position in `names`
  std::uint64_t points() const {   // each tool's lines close
    return tool.size();
  }
};

// Surfaces of the tools in space, for pictures: four corners a piece, rows of the field `tools/outline` in each frame; a
// triangle repeats its last one. Seen from the powder the corners run counter-clockwise.
struct ToolFaces {
  std::vector<std::string> names;     // of the tools
  std::vector<std::string> kinds;     // of the tools: plane, die, punch, stl
  std::vector<std::int32_t> corners;  // [pieces * 4]
  std::vector<std::int32_t> tool;     // [pieces], position in `names`
  std::uint64_t points = 0;           // rows of `tools/outline`
};

struct RunMesh {                            // fixed over the run
  std::vector<std::int32_t> quads;          // [cells * 4], node numbers, counter-clockwise
  std::vector<std::int32_t> cell_particle;  // [cells]
  std::vector<std::int32_t> node_particle;  // [nodes]
  std::vector<double> reference;  // [nodes * dimension], m, positions before the first step
  std::vector<std::int32_t> hexahedra = {};  // [cells * 8] instead of quads: a mesh in space
  std::vector<ParticleTag> tags = {};
  ToolLines tools = {};
  ToolFaces tool_faces = {};  // of a mesh in space, instead of lines
  int dimension() const { return hexahedra.empty() ? 2 : 3; }
};

struct RunAttributes {
  std::string version, commit, title, scene_hash;
  std::uint64_t seed = 0;
  int threads = 1;
};

}  // namespace pulvis

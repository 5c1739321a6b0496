// Recorder: writes the results of a run into its folder: run.h5 (everything), run.xdmf and
// run.vtkhdf (the frames, for ParaView and meshio; tools.vtkhdf: the tools) and history.csv (the history, for spreadsheets). It knows
// names, units and numbers, but no physics.
//
// run.h5 4096 bytes of text     "pulvis run 1": marks the file as Pulvis's own
//        /                      run (unique for every run), version, commit, title, scene_hash, seed, threads, finally outcome
//        /mesh/<name>           quads [cells,4] (hexahedra [cells,8] in space), cell_particle, node_particle, reference [nodes,2 or 3]
//        /particles/<name>      [particles] number, material, class; `names`: what the numbers stand for, one per line
//        /mesh/cell_<name>      [cells] material and class for each cell
//        /tools/lines           [lines, 2] which rows of a frame's tools/outline are joined; /tools/line_tool [lines]
//        /tools/quads           [pieces, 4] instead in space: corners of surfaces; /tools/quad_tool [pieces]
//        /frames/000000/<field> [places] or [places, components]; the group has time, step, and
//                               complete = 1, written last: a frame without it must not be read
//        /history/<name>        one 1-D dataset per series; /history/time
//        /<table>/<name>        one 1-D dataset per column, if the run has tables: rows are written with the history
//        /images/<name>         [lines, pixels], a raster image; attributes pixel_width, pixel_height in m
// Every dataset has the attributes unit and meaning, and xxh3, the checksum of its values: C++ readers refuse those that
// were changed since (engine/files/hdf5.hpp). A field also has place (node, cell, particle, list) and
// components. A field of nodes or cells with two components is stored with a third one of zeros, because
// XDMF has no plane vectors (components = 2 indicates this); `position` is not. XDMF shows these fields only.
//
// After frame() returns, the frame and every sample before it are on disk: a killed run loses only later
// data. From the hundredth frame on this holds only if frames are far enough apart; if they are so frequent that
// commits would take more than a thirtieth of the run, they share one, at the latest in position() and finish(). run.h5 can
// be read at any time, even while the run writes, and wherever it is killed: frames come with new groups /frames
// and /history, which replace the old ones atomically. (If the history exceeds a megabyte, the newest samples may be
// in history.csv only.) All system failures are reported as OutputError.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/files/growing_table.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/history_csv.hpp"
#include "engine/files/record.hpp"
#include "engine/files/vtk_hdf.hpp"
#include "engine/files/xdmf.hpp"

namespace pulvis {

// How far a run had written its results.
struct RecorderPosition {
  std::int64_t frames = 0, samples = 0;
  std::vector<std::int64_t> rows = {};  // of every table

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(frames, samples, rows);
  }
};

class Recorder {
 public:
  // `folder` exists (created by open_run_folder). `position` (node, as many components as the mesh has
  // dimensions) is the first field.
  Recorder(std::filesystem::path folder, const RunAttributes& attributes, const RunMesh& mesh,
           std::vector<SeriesInfo> series, std::vector<FieldInfo> fields,
           const SeriesInfo& abscissa = simulated_time, std::vector<TableInfo> tables = {});
  // Continues the files of a stopped run: whatever was written after `position` is cut off.
  Recorder(std::filesystem::path folder, const RunMesh& mesh, std::vector<SeriesInfo> series,
           std::vector<FieldInfo> fields, const RecorderPosition& position,
           const SeriesInfo& abscissa = simulated_time, std::vector<TableInfo> tables = {});

  // Commits everything so far to disk.
  RecorderPosition position();

  // One history row: one value per series, in order. Kept in memory until the next frame.
  void sample(double time, std::span<const double> values);

  // One row of the table at that position: one value per column. Kept in memory until the next frame.
  void row(std::size_t table, std::span<const double> values);
  // Number of rows of the table.
  std::int64_t rows(std::size_t table) const;

  // One frame. If any field has a wrong length, nothing is kept.
  void frame(double time, std::int64_t step, const FrameValues& values);
  void frame(double time, std::int64_t step, const std::vector<std::vector<double>>& fields);
  // From now on the fields that these take are not requested, but written by others.
  void share(FieldWriters writers) { writers_ = std::move(writers); }

  // An image, row by row: [lines, pixels]. If its pixels have a physical size, it is stored as pixel_width, pixel_height (m).
  void image(const SeriesInfo& info, std::uint64_t lines, std::uint64_t pixels,
             std::span<const double> values, const PixelSpacing& spacing = {});

  // Writes what is left and closes the files; `outcome` says in words how the run ended. Without this call
  // the destructor does the same as far as possible, and run.h5 has no outcome.
  void finish(std::string_view outcome = "done");
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  std::int64_t frames() const { return frames_; }
  // The attribute `run` of run.h5 and of the checkpoints: shows that they belong together.
  const std::string& run_id() const { return run_id_; }

 private:
  using Clock = std::chrono::steady_clock;

  void write_attributes(const RunAttributes& attributes);
  void put_in_place(const std::filesystem::path& folder);
  void show(double time, const std::string& group);
  void write_shown();
  void begin_change();
  void begin_frames();
  enum class Extent { due, whole };  // how much of the new data to commit
  void commit(Extent extent);
  bool is_commit_due() const;
  void check_length(const FieldInfo& field, std::size_t values) const;
  void write_frame(double time, std::int64_t step, const FrameValues& values);
  void write_history(const std::string& group, std::uint64_t kept);
  void renew_history();
  bool has_news() const;
  static bool is_due(std::int64_t rows, std::int64_t news, std::size_t columns);
  void link_frames();
  void cut(const RecorderPosition& position);
  void replace(const std::vector<std::string>& groups);
  void write_csv_again();
  bool is_written_by_others(const std::string& group, std::size_t number);
  void write_field(const std::string& group, const FieldInfo& field,
                   const std::vector<double>& values);
  void describe_field(const std::string& dataset, const FieldInfo& field);

  std::vector<SeriesInfo> series_;
  std::vector<FieldInfo> fields_;
  FieldWriters writers_;
  hdf5::File file_;
  HistoryCsv csv_;
  Xdmf xdmf_;
  VtkHdf vtk_hdf_;
  SeriesInfo abscissa_;
  std::string run_id_;
  std::vector<std::uint64_t> places_;         // number of places for each FieldPlace
  std::vector<double> pending_time_;          // samples not yet in run.h5
  std::vector<std::vector<double>> pending_;  // [series][sample]
  std::vector<std::pair<std::string, std::uint64_t>>
      unsummed_;  // filled by others, and where they begin
  std::vector<GrowingTable> tables_;
  std::int64_t frames_ = 0, samples_ = 0;              // samples: in run.h5
  bool is_changing_ = false, has_new_frames_ = false;  // since the last commit
  bool is_half_ = false;                               // a frame is being written
  Clock::time_point committed_ = Clock::now();
  Clock::duration linking_{}, cost_{};  // of the last commit: linking of its frames, and the total
  bool open_ = true;
};

}  // namespace pulvis

#include "engine/files/recorder.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "engine/files/describe.hpp"
#include "engine/files/file_descriptor.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_mesh.hpp"

namespace pulvis {
namespace {

// run.h5 starts with this much text, before the HDF5 part: it identifies the file as Pulvis's own.
constexpr std::uint64_t user_block_bytes = 4096;

// With a frame, the history and every grown table are rewritten, unless they are larger than this and have grown by less than an eighth.
constexpr std::uint64_t small_history_bytes = std::uint64_t{1} << 20;

// A commit lists every frame anew. The first frames get one each; later ones share one if commits would take
// more than this fraction of the run time.
constexpr std::int64_t frames_with_a_commit_each = 100;
constexpr double share_of_commits = 1.0 / 32;

// Identifies the run: unique. Not part of the state.
std::string new_run_id(const std::filesystem::path& folder) {
  std::array<std::uint64_t, 2> bits{};
  if (getrandom(bits.data(), sizeof bits, 0) != static_cast<ssize_t>(sizeof bits))
    throw OutputError(folder, "name the run", std::strerror(errno));
  return fmt::format("{:016x}{:016x}", bits[0], bits[1]);
}

// Marks the file as Pulvis's own before anything else is written.
hdf5::File marked_file(const std::filesystem::path& path) {
  hdf5::File file = hdf5::File::create_to_change(path, user_block_bytes);
  write_head(path, "pulvis run 1\n");
  return file;
}

std::string frame_name(std::int64_t number) { return fmt::format("/{:06}", number); }

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("recorder: " + what);
}

void check_mesh(const RunMesh& mesh) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension());
  require(mesh.quads.size() / 4 + mesh.hexahedra.size() / 8 == mesh.cell_particle.size(),
          "four node numbers a cell, eight in space");
  require(mesh.reference.size() == dimension * mesh.node_particle.size(),
          "two coordinates a node, three in space");
}

void check_fields(const RunMesh& mesh, const std::vector<FieldInfo>& fields) {
  require(!fields.empty() && fields.front().name == "position" &&
              fields.front().place == FieldPlace::node &&
              fields.front().components == mesh.dimension(),
          "the first field is position (node, 2 components, 3 in space)");
}

const char* name_of(FieldPlace place) {
  if (place == FieldPlace::node) return "node";
  if (place == FieldPlace::list) return "list";
  return place == FieldPlace::cell ? "cell" : "particle";
}

hdf5::Shape shape_of(std::uint64_t rows, int columns) {
  return columns == 1 ? hdf5::Shape{rows} : hdf5::Shape{rows, static_cast<std::uint64_t>(columns)};
}

}  // namespace

Recorder::Recorder(std::filesystem::path folder, const RunAttributes& attributes,
                   const RunMesh& mesh, std::vector<SeriesInfo> series,
                   std::vector<FieldInfo> fields, const SeriesInfo& abscissa,
                   std::vector<TableInfo> tables)
    : series_(std::move(series)),
      fields_(
          (check_mesh(mesh), check_fields(mesh, fields), std::move(fields))),  // before any file
      file_(marked_file(folder / "run.h5.new")),
      csv_(folder / "history.csv", abscissa, series_),
      xdmf_(folder / "run.xdmf", "run.h5", mesh, fields_),
      vtk_hdf_(folder, "run.h5", mesh, fields_),
      abscissa_(abscissa),
      run_id_(new_run_id(file_.path())),
      places_{mesh.node_particle.size(), mesh.cell_particle.size()},
      pending_(series_.size()),
      tables_(growing_tables(std::move(tables))) {
  survive_a_full_quota();
  write_attributes(attributes);
  file_.make_group("/frames");
  write_mesh(file_, mesh);
  write_history("/history", 0);
  for (const GrowingTable& table : tables_) table.make(file_);
  file_.flush();
  file_.close();
  put_in_place(folder);
}

// run.h5 is readable from its first moment on, whatever happens.
void Recorder::put_in_place(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "run.h5";
  std::error_code error;
  std::filesystem::rename(file_.path(), path, error);
  if (error) throw OutputError(path, "move the file to its final name", error.message());
  sync_folder(folder);
  file_ = hdf5::File::open_to_change(path);
}

Recorder::Recorder(std::filesystem::path folder, const RunMesh& mesh,
                   std::vector<SeriesInfo> series, std::vector<FieldInfo> fields,
                   const RecorderPosition& position, const SeriesInfo& abscissa,
                   std::vector<TableInfo> tables)
    : series_(std::move(series)),
      fields_((check_mesh(mesh), check_fields(mesh, fields), std::move(fields))),
      file_(hdf5::File::open_to_change(folder / "run.h5")),
      csv_(folder / "history.csv", abscissa, series_),
      xdmf_(folder / "run.xdmf", "run.h5", mesh, fields_),
      vtk_hdf_(folder, "run.h5", mesh, fields_),
      abscissa_(abscissa),
      run_id_(file_.text_attribute("/", "run")),
      places_{mesh.node_particle.size(), mesh.cell_particle.size()},
      pending_(series_.size()),
      tables_(growing_tables(std::move(tables))) {
  survive_a_full_quota();
  cut(position);
  write_csv_again();
}

// Data after `position` is not copied to the replacement.
void Recorder::cut(const RecorderPosition& position) {
  const auto rows = static_cast<std::uint64_t>(position.samples);
  const std::uint64_t rows_there = file_.shape("/history/time").front();
  const auto there = static_cast<std::int64_t>(file_.children("/frames").size());
  if (there < position.frames || rows_there < rows)
    throw OutputError(
        file_.path(), "continue",
        fmt::format(
            "frames or samples are missing: {} and {} are present, {} and {} had been written",
            there, rows_there, position.frames, rows));
  for (; frames_ < position.frames; ++frames_) {
    const std::string group = "/frames" + frame_name(frames_);
    show(file_.number_attribute(group, "time"), group);
  }
  if (there > 0) write_shown();  // first: nothing then refers to a removed frame
  samples_ = position.samples;
  begin_change();
  link_frames();
  write_history("/history.next", rows);
  if (file_.has_attribute("/", "outcome")) file_.remove_attribute("/", "outcome");
  if (file_.contains("/images")) file_.remove("/images");  // recreated when the run ends
  std::vector<std::string> renewed{"/frames", "/history"};
  require(position.rows.size() == tables_.size(), "a position counts the rows of every table");
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    tables_[i].cut(file_, position.rows[i]);
    renewed.push_back(tables_[i].group());
  }
  replace(renewed);
  committed_ = Clock::now();
}

// The frame for other programs.
void Recorder::show(double time, const std::string& group) {
  xdmf_.add(time, group);
  vtk_hdf_.add(time, group);
}

void Recorder::write_shown() {
  xdmf_.write();
  vtk_hdf_.write();
}

void Recorder::begin_change() {
  if (std::exchange(is_changing_, true)) return;
  file_.begin_change();
}

void Recorder::link_frames() {
  file_.make_group("/frames.next");
  for (std::int64_t i = 0; i < frames_; ++i)
    file_.link("/frames" + frame_name(i), "/frames.next" + frame_name(i));
  has_new_frames_ = true;
}

// Nothing that run.h5 refers to changes before this; the change itself affects only its first page.
void Recorder::replace(const std::vector<std::string>& groups) {
  for (const std::string& group : groups) {
    file_.rename(group, group + ".old");
    file_.rename(group + ".next", group);
  }
  for (const std::string& group : groups)
    file_.remove(group + ".old");  // last: its space is free now
  file_.commit_change();
  has_new_frames_ = is_changing_ = false;
}

void Recorder::write_csv_again() {
  std::vector<std::vector<double>> columns;
  for (const SeriesInfo& series : series_)
    columns.push_back(file_.read_doubles("/history/" + series.name));
  const std::vector<double> times = file_.read_doubles("/history/time");
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][i];
    csv_.add(times[i], row);
  }
  csv_.flush();
}

// Includes the frames of the current change, if any.
void Recorder::commit(Extent extent) {
  const Clock::time_point begin = Clock::now();
  begin_change();
  std::vector<std::string> renewed;
  if (has_new_frames_) renewed.emplace_back("/frames");
  const std::int64_t news = std::ssize(pending_time_);
  if (extent == Extent::whole ? news > 0 : is_due(samples_, news, series_.size() + 1)) {
    renew_history();
    renewed.emplace_back("/history");
  }
  for (GrowingTable& table : tables_) {
    const bool due = is_due(table.written(), table.waiting(), table.columns());
    if (!table.has_news() || (extent == Extent::due && !due)) continue;
    table.renew(file_);
    renewed.push_back(table.group());
  }
  const bool has_new_frames = has_new_frames_;
  if (has_new_frames && writers_.flush) writers_.flush();
  for (const auto& [dataset, from] : std::exchange(unsummed_, {}))
    file_.record_checksum(dataset, from);
  replace(renewed);
  csv_.flush();
  if (has_new_frames) write_shown();
  committed_ = Clock::now();
  cost_ = linking_ + (committed_ - begin);
}

bool Recorder::has_news() const {
  return !pending_time_.empty() || std::ranges::any_of(tables_, &GrowingTable::has_news);
}

RecorderPosition Recorder::position() {
  if (is_changing_ || has_news())
    commit(Extent::whole);
  else
    csv_.flush();
  RecorderPosition position{frames_, samples_};
  for (const GrowingTable& table : tables_) position.rows.push_back(table.written());
  return position;
}

Recorder::~Recorder() {
  if (!open_) return;
  try {
    if (is_half_)
      file_.remove("/frames.next");  // with everything since the last commit
    else
      position();
    csv_.close();
    file_.close();
  } catch (const std::exception&) {  // the first failure was already thrown by sample or frame
  }
}

void Recorder::write_attributes(const RunAttributes& attributes) {
  file_.set_attribute("/", "format", std::int64_t{1});
  file_.set_attribute("/", "run", std::string_view(run_id_));
  file_.set_attribute("/", "version", std::string_view(attributes.version));
  file_.set_attribute("/", "commit", std::string_view(attributes.commit));
  file_.set_attribute("/", "title", std::string_view(attributes.title));
  file_.set_attribute("/", "scene_hash", std::string_view(attributes.scene_hash));
  file_.set_attribute("/", "seed", attributes.seed);
  file_.set_attribute("/", "threads", std::int64_t{attributes.threads});
}

// The first `kept` rows of /history, and the samples since then.
void Recorder::write_history(const std::string& group, std::uint64_t kept) {
  const auto write = [&](const SeriesInfo& series, const std::string& name,
                         const std::vector<double>& values) {
    file_.write_series(group + "/" + name, "/history/" + name, kept, values);
    describe(file_, group + "/" + name, series.unit, series.meaning, series.label);
  };
  for (std::size_t i = 0; i < series_.size(); ++i) write(series_[i], series_[i].name, pending_[i]);
  write(abscissa_, "time", pending_time_);
}

void Recorder::renew_history() {
  write_history("/history.next", static_cast<std::uint64_t>(samples_));
  samples_ += static_cast<std::int64_t>(pending_time_.size());
  for (std::vector<double>& values : pending_) values.clear();
  pending_time_.clear();
}

bool Recorder::is_due(std::int64_t rows, std::int64_t news, std::size_t columns) {
  const auto bytes = static_cast<std::uint64_t>(rows + news) * columns * sizeof(double);
  return bytes <= small_history_bytes || 8 * news >= rows;
}

void Recorder::sample(double time, std::span<const double> values) {
  require(values.size() == series_.size(), "a sample holds one value a series");
  csv_.add(time, values);
  pending_time_.push_back(time);
  for (std::size_t i = 0; i < values.size(); ++i) pending_[i].push_back(values[i]);
}

void Recorder::row(std::size_t table, std::span<const double> values) {
  tables_.at(table).add(values);
}

std::int64_t Recorder::rows(std::size_t table) const {
  return tables_.at(table).written() + tables_.at(table).waiting();
}

void Recorder::frame(double time, std::int64_t step,
                     const std::vector<std::vector<double>>& fields) {
  require(fields.size() == fields_.size(), "a frame holds every field");
  for (std::size_t i = 0; i < fields.size(); ++i) check_length(fields_[i], fields[i].size());
  frame(time, step, [&](std::size_t field) { return fields[field]; });
}

void Recorder::frame(double time, std::int64_t step, const FrameValues& values) {
  is_half_ = true;
  begin_frames();
  write_frame(time, step, values);
  is_half_ = false;
  show(time, "/frames" + frame_name(frames_));
  ++frames_;
  if (is_commit_due()) commit(Extent::due);
}

// The new group of frames, starting with the existing ones.
void Recorder::begin_frames() {
  if (has_new_frames_) return;
  const Clock::time_point begin = Clock::now();
  begin_change();
  link_frames();
  linking_ = Clock::now() - begin;
}

bool Recorder::is_commit_due() const {
  return frames_ <= frames_with_a_commit_each ||
         share_of_commits * (Clock::now() - committed_) >= cost_;
}

void Recorder::check_length(const FieldInfo& field, std::size_t values) const {
  const auto columns = static_cast<std::size_t>(field.components);
  const bool fits = is_of_mesh(field)
                        ? values == columns * places_[static_cast<std::size_t>(field.place)]
                        : values % columns == 0;
  require(fits, "field " + field.name + " has a wrong length");
}

void Recorder::write_frame(double time, std::int64_t step, const FrameValues& values) {
  const std::string group = "/frames.next" + frame_name(frames_);
  file_.make_group(group);
  file_.set_attribute(group, "time", time);
  file_.set_attribute(group, "step", step);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (is_written_by_others(group, i)) continue;
    const std::vector<double> of_field = values(i);
    check_length(fields_[i], of_field.size());
    write_field(group, fields_[i], of_field);
  }
  file_.set_attribute(group, "complete", std::int64_t{1});
}

bool Recorder::is_written_by_others(const std::string& group, std::size_t number) {
  if (!writers_.takes || !writers_.takes(number)) return false;
  const FieldInfo& field = fields_[number];
  require(is_of_mesh(field) && !field.whole, "field " + field.name + " is not of the mesh");
  const int stored = stored_components(field);
  const std::string dataset = group + "/" + field.name;
  const auto begin =
      file_.make_room(dataset, hdf5::Number::real,
                      shape_of(places_[static_cast<std::size_t>(field.place)], stored));
  if (!begin) return false;
  describe_field(dataset, field);
  if (*begin > 0) unsummed_.push_back({dataset, *begin});
  writers_.write(number, {{std::filesystem::absolute(file_.path()).string(), *begin},
                          field.place,
                          field.components,
                          stored});
  return true;
}

void Recorder::write_field(const std::string& group, const FieldInfo& field,
                           const std::vector<double>& values) {
  const int stored = stored_components(field);
  const std::string dataset = group + "/" + field.name;
  const hdf5::Shape shape =
      shape_of(values.size() / static_cast<std::size_t>(field.components), stored);
  if (field.whole) {
    file_.write(dataset, std::vector<std::int32_t>(values.begin(), values.end()), shape);
  } else if (stored == field.components) {
    file_.write(dataset, values, shape);
  } else {
    file_.write(dataset, with_zero_third(values), shape);
  }
  describe_field(dataset, field);
}

void Recorder::describe_field(const std::string& dataset, const FieldInfo& field) {
  describe(file_, dataset, field.unit, field.meaning, field.label);
  file_.set_attribute(dataset, "place", std::string_view(name_of(field.place)));
  file_.set_attribute(dataset, "components", std::int64_t{field.components});
}

void Recorder::image(const SeriesInfo& info, std::uint64_t lines, std::uint64_t pixels,
                     std::span<const double> values, const PixelSpacing& spacing) {
  require(lines * pixels == values.size(), "image " + info.name + " has a wrong length");
  begin_change();
  const std::string dataset = "/images/" + info.name;
  file_.write(dataset, values, {lines, pixels});
  describe(file_, dataset, info.unit, info.meaning, info.label);
  if (!(spacing.along > 0)) return;
  file_.set_attribute(dataset, "pixel_width", spacing.along);
  file_.set_attribute(dataset, "pixel_height", spacing.across);
}

void Recorder::finish(std::string_view outcome) {
  if (!std::exchange(open_, false)) return;
  begin_change();
  file_.set_attribute("/", "outcome", outcome);
  commit(Extent::whole);
  xdmf_.finish();
  csv_.close();
  file_.close();
}

}  // namespace pulvis

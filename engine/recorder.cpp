#include "engine/recorder.hpp"

#include <fmt/format.h>

#include <csignal>
#include <stdexcept>
#include <utility>

#include "engine/file_descriptor.hpp"
#include "engine/output_error.hpp"

namespace pulvis {
namespace {

constexpr std::uint64_t history_chunk = 1024;  // 8 kB a series: a thousand samples in one piece

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

std::vector<double> with_zero_third(const std::vector<double>& plane) {
  std::vector<double> space(plane.size() / 2 * 3, 0.0);
  for (std::size_t i = 0; i < plane.size() / 2; ++i) {
    space[3 * i] = plane[2 * i];
    space[3 * i + 1] = plane[2 * i + 1];
  }
  return space;
}

// A file beyond the allowed size would end the program: it shall be an error like any other.
void survive_a_full_quota() {
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

}  // namespace

Recorder::Recorder(std::filesystem::path folder, const RunAttributes& attributes,
                   const RunMesh& mesh, std::vector<SeriesInfo> series,
                   std::vector<FieldInfo> fields, const SeriesInfo& abscissa)
    : series_(std::move(series)),
      fields_(
          (check_mesh(mesh), check_fields(mesh, fields), std::move(fields))),  // before any file
      file_(hdf5::File::create(folder / "run.h5.new")),
      csv_(folder / "history.csv", abscissa, series_),
      xdmf_(folder / "run.xdmf", "run.h5", mesh, fields_),
      places_{mesh.node_particle.size(), mesh.cell_particle.size()},
      pending_(series_.size()) {
  survive_a_full_quota();
  write_attributes(attributes);
  write_mesh(mesh);
  file_.make_group("/frames");
  make_history(abscissa);
  file_.flush();
  file_.close();
  put_in_place(folder);
}

// From its first moment on run.h5 can be read, whatever happens.
void Recorder::put_in_place(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "run.h5";
  std::error_code error;
  std::filesystem::rename(file_.path(), path, error);
  if (error) throw OutputError(path, "put the file in its place", error.message());
  sync_folder(folder);
  file_ = hdf5::File::open_to_change(path);
}

Recorder::Recorder(std::filesystem::path folder, const RunMesh& mesh,
                   std::vector<SeriesInfo> series, std::vector<FieldInfo> fields,
                   const RecorderPosition& position, const SeriesInfo& abscissa)
    : series_(std::move(series)),
      fields_((check_mesh(mesh), check_fields(mesh, fields), std::move(fields))),
      file_(hdf5::File::open_to_change(folder / "run.h5")),
      csv_(folder / "history.csv", abscissa, series_),
      xdmf_(folder / "run.xdmf", "run.h5", mesh, fields_),
      places_{mesh.node_particle.size(), mesh.cell_particle.size()},
      pending_(series_.size()) {
  survive_a_full_quota();
  cut(position);
  write_csv_again();
}

void Recorder::cut(const RecorderPosition& position) {
  const auto rows = static_cast<std::uint64_t>(position.samples);
  for (const SeriesInfo& series : series_) file_.shorten("/history/" + series.name, rows);
  file_.shorten("/history/time", rows);
  for (const std::string& frame : file_.children("/frames"))
    if (std::stoll(frame) >= position.frames) file_.remove("/frames/" + frame);
  if (file_.has_attribute("/", "outcome")) file_.remove_attribute("/", "outcome");
  if (file_.contains("/images")) file_.remove("/images");  // made anew when the run ends
  const auto there = static_cast<std::int64_t>(file_.children("/frames").size());
  if (there != position.frames || file_.shape("/history/time").front() != rows)
    throw OutputError(
        file_.path(), "go on",
        fmt::format("frames or samples are missing: {} and {} are there, {} and {} "
                    "had been written",
                    there, file_.shape("/history/time").front(), position.frames, rows));
  for (; frames_ < there; ++frames_) {
    const std::string group = fmt::format("/frames/{:06}", frames_);
    xdmf_.keep(file_.number_attribute(group, "time"), group);
  }
  samples_ = position.samples;
  file_.flush();
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

RecorderPosition Recorder::position() {
  append_history();
  file_.flush();
  csv_.flush();
  return {frames_, samples_};
}

Recorder::~Recorder() {
  if (!open_) return;
  try {
    append_history();
    csv_.close();
    file_.close();
  } catch (const std::exception&) {  // the first failure was already thrown from sample or frame
  }
}

void Recorder::describe(const std::string& object, const std::string& unit,
                        const std::string& meaning) {
  file_.set_attribute(object, "unit", std::string_view(unit));
  file_.set_attribute(object, "meaning", std::string_view(meaning));
}

void Recorder::write_attributes(const RunAttributes& attributes) {
  file_.set_attribute("/", "format", std::int64_t{1});
  file_.set_attribute("/", "version", std::string_view(attributes.version));
  file_.set_attribute("/", "commit", std::string_view(attributes.commit));
  file_.set_attribute("/", "title", std::string_view(attributes.title));
  file_.set_attribute("/", "scene_hash", std::string_view(attributes.scene_hash));
  file_.set_attribute("/", "seed", attributes.seed);
  file_.set_attribute("/", "threads", std::int64_t{attributes.threads});
}

void Recorder::write_mesh(const RunMesh& mesh) {
  constexpr auto packed = hdf5::Packing::shuffle_gzip;
  const std::uint64_t nodes = mesh.node_particle.size(), cells = mesh.cell_particle.size();
  const auto dimension = static_cast<std::uint64_t>(mesh.dimension());
  const bool in_space = dimension == 3;
  const std::string connectivity = in_space ? "/mesh/hexahedra" : "/mesh/quads";
  file_.write(connectivity, in_space ? mesh.hexahedra : mesh.quads, {cells, in_space ? 8U : 4U},
              packed);
  describe(connectivity, "-", "node numbers of each cell, counter-clockwise");
  file_.write("/mesh/cell_particle", mesh.cell_particle, {cells}, packed);
  describe("/mesh/cell_particle", "-", "particle each cell belongs to");
  file_.write("/mesh/node_particle", mesh.node_particle, {nodes}, packed);
  describe("/mesh/node_particle", "-", "particle each node belongs to");
  file_.write("/mesh/reference", mesh.reference, {nodes, dimension}, packed);
  describe("/mesh/reference", "m", "positions of the nodes before the first step");
}

void Recorder::make_history(const SeriesInfo& abscissa) {
  file_.make_series("/history/time", history_chunk);
  describe("/history/time", abscissa.unit, abscissa.meaning);
  for (const auto& series : series_) {
    file_.make_series("/history/" + series.name, history_chunk);
    describe("/history/" + series.name, series.unit, series.meaning);
  }
}

void Recorder::sample(double time, std::span<const double> values) {
  require(values.size() == series_.size(), "a sample holds one value a series");
  csv_.add(time, values);
  pending_time_.push_back(time);
  for (std::size_t i = 0; i < values.size(); ++i) pending_[i].push_back(values[i]);
}

void Recorder::append_history() {
  for (std::size_t i = 0; i < series_.size(); ++i) {
    file_.append("/history/" + series_[i].name, pending_[i]);
    pending_[i].clear();
  }
  file_.append("/history/time", pending_time_);  // last: every series is at least as long
  samples_ += static_cast<std::int64_t>(pending_time_.size());
  pending_time_.clear();
}

void Recorder::frame(double time, std::int64_t step,
                     const std::vector<std::vector<double>>& fields) {
  require(fields.size() == fields_.size(), "a frame holds every field");
  const std::string group = fmt::format("/frames/{:06}", frames_);
  file_.make_group(group);
  file_.set_attribute(group, "time", time);
  file_.set_attribute(group, "step", step);
  for (std::size_t i = 0; i < fields.size(); ++i) write_field(group, fields_[i], fields[i]);
  append_history();
  file_.set_attribute(group, "complete", std::int64_t{1});
  file_.flush();
  csv_.flush();
  xdmf_.add(time, group);
  ++frames_;
}

void Recorder::write_field(const std::string& group, const FieldInfo& field,
                           const std::vector<double>& values) {
  const auto columns = static_cast<std::uint64_t>(field.components);
  const std::uint64_t rows = values.size() / columns;
  const bool fixed = is_of_mesh(field);
  const bool fits = !fixed || rows == places_[static_cast<std::size_t>(field.place)];
  require(fits && rows * columns == values.size(), "field " + field.name + " has a wrong length");
  const auto stored = static_cast<std::uint64_t>(stored_components(field));
  const std::string dataset = group + "/" + field.name;
  const hdf5::Shape shape = stored == 1 ? hdf5::Shape{rows} : hdf5::Shape{rows, stored};
  if (field.whole) {
    file_.write(dataset, std::vector<std::int32_t>(values.begin(), values.end()), shape);
  } else if (stored == columns) {
    file_.write(dataset, values, shape);
  } else {
    file_.write(dataset, with_zero_third(values), shape);
  }
  describe(dataset, field.unit, field.meaning);
  file_.set_attribute(dataset, "place", std::string_view(name_of(field.place)));
  file_.set_attribute(dataset, "components", std::int64_t{field.components});
}

void Recorder::image(const SeriesInfo& info, std::uint64_t lines, std::uint64_t pixels,
                     std::span<const double> values) {
  require(lines * pixels == values.size(), "image " + info.name + " has a wrong length");
  const std::string dataset = "/images/" + info.name;
  file_.write(dataset, values, {lines, pixels});
  describe(dataset, info.unit, info.meaning);
}

void Recorder::finish(std::string_view outcome) {
  if (!std::exchange(open_, false)) return;
  append_history();
  file_.set_attribute("/", "outcome", outcome);
  file_.flush();
  csv_.close();
  file_.close();
}

}  // namespace pulvis

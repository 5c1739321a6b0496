// Columns as numpy arrays that share their memory.
//
// Particle rows are stored in chunks of eight particles, one per lane: [chunk][row][number][lane]. The data of one
// particle is a strided view of it; chunks of particles with the same mesh are contiguous and form a block. Rows that
// come and go (contacts) are copied, since their memory does not persist.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <set>
#include <string_view>

#include "cli/python/module/limits.hpp"
#include "cli/python/module/module.hpp"
#include "cli/python/module/python_run.hpp"
#include "components/shape.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

bool is_laned(const ColumnBase& column) {
  static const std::set<std::string> entities{Node::name, BoundaryNode::name, Element::name,
                                              Particle::name};
  return entities.contains(column.entity);
}
// Their number changes during the run.
bool comes_and_goes(const ColumnBase& column) {
  return column.entity == Contact::name || column.entity == ToolContact::name;
}
std::string full_name(const ColumnBase& column) { return column.entity + "." + column.info.name; }
py::ssize_t bytes_of_value(const ColumnBase& column) {
  return static_cast<py::ssize_t>(column.row_bytes) / column.count /
         (is_laned(column) ? lane_count : 1);
}
py::dtype type_of_values(const ColumnBase& column) {
  switch (bytes_of_value(column)) {
    case 8:
      return py::dtype::of<double>();
    case 4:
      return py::dtype::of<std::int32_t>();
    default:
      return py::dtype::of<std::uint8_t>();
  }
}

World& world_of(PythonRun& run) { return run.session().simulation().world(); }

// By full name, "tool.velocity", or by short name: particle columns first.
const ColumnBase& find_column(PythonRun& run, const std::string& name) {
  const ColumnBase* found = nullptr;
  std::vector<std::string> known;
  for (const ColumnBase* column : world_of(run).columns()) {
    known.push_back(full_name(*column));
    if (full_name(*column) == name) return *column;
    if (column->info.name == name && (found == nullptr || is_laned(*column))) found = column;
  }
  if (found != nullptr) return *found;
  throw py::key_error(fmt::format("there is no column '{}'{}, allowed: {}", name,
                                  suggestion(name, known), listed(known)));
}

const ColumnBase& readable_column(PythonRun& run, const std::string& name) {
  const ColumnBase& column = find_column(run, name);
  const bool observed = run.session().observed() || run.session().ended();
  if (column.has_transient() && !observed)
    throw NotNow(
        fmt::format("column '{}' is not kept from step to step; allowed: in "
                    "sim.on_sample(f) and sim.on_frame(f), or after the run has ended",
                    full_name(column)));
  return column;
}

void require_writable(PythonRun& run, const ColumnBase& column) {
  const std::string name = full_name(column);
  if (writable_column(name) == nullptr) {
    std::vector<std::string> allowed;
    for (const WritableColumn& one : writable_columns) allowed.emplace_back(one.name);
    throw NotNow(
        fmt::format("column '{}' cannot be changed: contacts, energies or the stable time "
                    "step would no longer be consistent with it; allowed: {}",
                    name, listed(allowed)));
  }
  run.session_between_steps(("column '" + name + "'").c_str());
  if (name == "node.velocity") return;
  for (const MaterialSpec& material : run.session().loaded().scene.materials)
    if (material.flow && name != "particle.mass_damping")
      throw NotNow(
          fmt::format("column '{}' does not enter the hardening law of material '{}', allowed: "
                      "with linear hardening",
                      name, material.name));
}

py::array array_over(const ColumnBase& column, const py::object& owner, std::size_t offset,
                     std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                     bool writable) {
  auto* data = const_cast<std::byte*>(column.data()) + offset;
  py::array array(type_of_values(column), std::move(shape), std::move(strides), data, owner);
  if (!writable) array.attr("flags").attr("writeable") = false;
  return array;
}

std::size_t offset_of_chunk(const ColumnBase& column, int chunk) {
  return static_cast<std::size_t>(column.of_chunk(chunk).data() - column.data());
}
py::ssize_t rows_of_chunk(const ColumnBase& column, int chunk) {
  return static_cast<py::ssize_t>(column.of_chunk(chunk).size() / column.row_bytes);
}

// [rows, numbers] of the particle with this number in the scene.
py::array of_particle(const std::shared_ptr<PythonRun>& run, const std::string& name, int number) {
  const ColumnBase& column = readable_column(*run, name);
  const Bodies& bodies = world_of(*run).resource<Bodies>();
  if (!is_laned(column))
    throw NotNow(fmt::format("column '{}' has no rows of a particle", full_name(column)));
  if (number < 0 || number >= bodies.particles())
    throw py::index_error(
        fmt::format("particle {}, allowed: 0 to {}", number, bodies.particles() - 1));
  const ChunkLane at(bodies.slot_of_number[static_cast<std::size_t>(number)]);
  const py::ssize_t size = bytes_of_value(column);
  return array_over(
      column, py::cast(run),
      offset_of_chunk(column, at.chunk.index) + static_cast<std::size_t>(at.lane * size),
      {rows_of_chunk(column, at.chunk.index), column.count},
      {column.count * lane_count * size, lane_count * size}, false);
}

py::array_t<std::int32_t> numbers_in(const Bodies& bodies, int chunk, int chunks) {
  py::array_t<std::int32_t> numbers({chunks, lane_count});
  auto to = numbers.mutable_unchecked<2>();
  for (int c = 0; c < chunks; ++c)
    for (int lane = 0; lane < lane_count; ++lane)
      to(c, lane) = bodies.slots[static_cast<std::size_t>((chunk + c) * lane_count + lane)].number;
  return numbers;
}

// Pairs (numbers [chunks, lanes], values [chunks, lanes, rows, numbers]) of consecutive chunks with the same mesh.
py::list blocks_of(const std::shared_ptr<PythonRun>& run, const std::string& name, bool writable) {
  const ColumnBase& column = readable_column(*run, name);
  const Bodies& bodies = world_of(*run).resource<Bodies>();
  if (!is_laned(column))
    throw NotNow(fmt::format("column '{}' has no rows of particles", full_name(column)));
  if (writable) require_writable(*run, column);
  const auto shape_at = [&](int chunk) {
    return bodies.slots[static_cast<std::size_t>(chunk * lane_count)].shape;
  };
  py::list blocks;
  for (int first = 0; first < bodies.chunks();) {
    int last = first + 1;
    while (last < bodies.chunks() && shape_at(last) == shape_at(first)) ++last;
    const py::ssize_t rows = rows_of_chunk(column, first), size = bytes_of_value(column);
    const py::ssize_t row = column.count * lane_count * size;
    blocks.append(py::make_tuple(numbers_in(bodies, first, last - first),
                                 array_over(column, py::cast(run), offset_of_chunk(column, first),
                                            {last - first, lane_count, rows, column.count},
                                            {rows * row, size, row, lane_count * size}, writable)));
    first = last;
  }
  return blocks;
}

// A block as blocks_of returns it, to be written in the place of `before`: throws OutOfRange for the first new value
// that a scene would refuse.
void check_block(PythonRun& run, const std::string& name, const py::array_t<std::int32_t>& numbers,
                 const py::array_t<double>& now, const py::array_t<double>& before) {
  const ColumnBase& column = find_column(run, name);
  const WritableColumn& writable = *writable_column(full_name(column));
  const Scene& scene = run.session().loaded().scene;
  const Bodies& bodies = world_of(run).resource<Bodies>();
  const auto number_of = numbers.unchecked<2>();
  const auto value = now.unchecked<4>(), old = before.unchecked<4>();
  for (py::ssize_t c = 0; c < value.shape(0); ++c)
    for (py::ssize_t lane = 0; lane < value.shape(1); ++lane) {
      const int number = number_of(c, lane);
      if (number < 0) continue;
      const int slot = bodies.slot_of_number[static_cast<std::size_t>(number)];
      const schema::KeyInfo limits =
          limits_of(writable, scene, bodies.slots[static_cast<std::size_t>(slot)].material);
      for (py::ssize_t row = 0; row < value.shape(2); ++row)
        for (py::ssize_t k = 0; k < value.shape(3); ++k) {
          const double given = value(c, lane, row, k);
          if (given == old(c, lane, row, k)) continue;
          const std::string fault = fault_of(given, limits);
          if (!fault.empty())
            throw OutOfRange(fmt::format(
                "column '{}': particle {}{}: {}; nothing of what was written is kept",
                full_name(column), number,
                column.entity == Particle::name ? "" : fmt::format(", row {}, number {}", row, k),
                fault));
        }
    }
}

// [rows, numbers] of columns not of particles: a view, or a copy for rows that come and go.
py::array rows_of_column(const std::shared_ptr<PythonRun>& run, const std::string& name) {
  const ColumnBase& column = readable_column(*run, name);
  const auto rows = static_cast<py::ssize_t>(column.bytes() / column.row_bytes);
  const py::ssize_t size = bytes_of_value(column);
  py::array view = array_over(column, py::cast(run), 0, {rows, column.count},
                              {column.count * size, size}, false);
  return comes_and_goes(column) ? py::array(view.attr("copy")()) : view;
}

py::dict info_of(const ColumnBase& column) {
  py::dict one;
  one["name"] = full_name(column);
  one["entity"] = column.entity;
  one["unit"] = column.info.unit;
  one["meaning"] = column.info.meaning;
  one["numbers"] = column.count;
  one["rows"] = column.bytes() / column.row_bytes * (is_laned(column) ? lane_count : 1);
  one["bytes"] = column.bytes();
  one["of_particles"] = is_laned(column);
  one["shares_memory"] = !comes_and_goes(column);
  one["writable"] = writable_column(full_name(column)) != nullptr;
  one["only_at_samples"] = column.has_transient();
  return one;
}

}  // namespace

void bind_columns(py::module_& core) {
  py::object type = core.attr("Run");
  auto run = py::reinterpret_borrow<py::class_<PythonRun, std::shared_ptr<PythonRun>>>(type);
  run.def_property_readonly("columns",
                            [](PythonRun& r) {
                              py::list all;
                              for (const ColumnBase* column : world_of(r).columns())
                                all.append(info_of(*column));
                              return all;
                            })
      .def("column_info",
           [](PythonRun& r, const std::string& name) { return info_of(find_column(r, name)); })
      .def_property_readonly(
          "particles", [](PythonRun& r) { return world_of(r).resource<Bodies>().particles(); })
      .def("column_of_particle", &of_particle, py::arg("name"), py::arg("number"))
      .def("column_blocks", &blocks_of, py::arg("name"), py::arg("writable") = false)
      .def("check_block", &check_block)
      .def("column_rows", &rows_of_column)
      .def("written",
           [](PythonRun& r, const std::string& name) { r.session().drive("column " + name); });
}

}  // namespace pulvis::python

// Packings and meshes on their own, without a run.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>

#include "cli/python/module/module.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/meshes/hexahedra/mesh.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

py::array_t<double> pairs(const std::vector<std::array<double, 2>>& points) {
  py::array_t<double> all({points.size(), std::size_t{2}});
  std::copy_n(points.empty() ? nullptr : points.front().data(), 2 * points.size(),
              all.mutable_data());
  return all;
}

void require_particles(const LoadedScene& loaded) {
  if (loaded.scene.afm)
    throw SceneError({{loaded.scene.file.string(), 1, 1, "", "family",
                       "an AFM scene has no particles, allowed: a scene with particles"}});
}

template <class Number>
py::array_t<Number> table_of(std::size_t rows, std::size_t columns) {
  return py::array_t<Number>({rows, columns});
}
py::ssize_t array_index(std::size_t i) { return static_cast<py::ssize_t>(i); }

py::dict mesh_in_space(const Scene& scene, int number) {
  const auto& particles = scene.particles;
  const auto& particle = particles[static_cast<std::size_t>(number)];
  const space::Shape shape = space::make_shape(particle);
  auto nodes = table_of<double>(shape.nodes.size(), 3);
  for (std::size_t n = 0; n < shape.nodes.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      nodes.mutable_at(array_index(n), array_index(k)) = shape.nodes[n][k];
  auto hexahedra = table_of<std::int32_t>(shape.hexahedra.size(), 8);
  for (std::size_t e = 0; e < shape.hexahedra.size(); ++e)
    for (std::size_t k = 0; k < 8; ++k)
      hexahedra.mutable_at(array_index(e), array_index(k)) = shape.hexahedra[e][k].value;
  auto faces = table_of<std::int32_t>(shape.faces.size(), 4);
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k)
      faces.mutable_at(array_index(f), array_index(k)) = shape.faces[f].corner[k].value;
  py::dict all;
  all["name"] = particle.name;
  all["nodes"] = nodes;
  all["hexahedra"] = hexahedra;
  all["faces"] = faces;
  all["surface_nodes"] = shape.boundary_nodes;
  all["volume"] = shape.true_volume;
  all["area"] = shape.area;
  return all;
}

// By particle number, the quaternion w, x, y, z of the rotation from the body frame.
py::array_t<double> rotations_of(const std::vector<BodySpec>& bodies) {
  auto rotations = table_of<double>(bodies.size(), 4);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Rotation& turn = bodies[i].rotation;
    const std::array quaternion{turn.w(), turn.x(), turn.y(), turn.z()};
    for (std::size_t k = 0; k < 4; ++k)
      rotations.mutable_at(array_index(i), array_index(k)) = quaternion[k];
  }
  return rotations;
}

py::array_t<double> angles_of(const std::vector<BodySpec>& bodies) {
  py::array_t<double> angles(array_index(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    angles.mutable_at(array_index(i)) = bodies[i].angle;
  return angles;
}

// m, names, and rad or quaternions: all particles in order of their numbers.
py::dict packing_of(const LoadedScene& loaded) {
  require_particles(loaded);
  const Scene& scene = loaded.scene;
  std::vector<BodySpec> bodies;
  {
    py::gil_scoped_release others_may_run;
    bodies = place_bodies(scene);
    check_overlaps(scene, bodies);
  }
  auto centres = table_of<double>(bodies.size(), static_cast<std::size_t>(scene.dimension));
  py::array_t<std::int32_t> classes(array_index(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (int k = 0; k < scene.dimension; ++k)
      centres.mutable_at(array_index(i), k) = bodies[i].position[k];
    classes.mutable_at(array_index(i)) = bodies[i].particle;
  }
  py::list names;
  for (const ParticleSpec& particle : scene.particles) names.append(particle.name);
  for (const ParticleSpec& grain : scene.grains) names.append(grain.name);
  py::dict all;
  all["centres"] = centres;
  if (scene.in_space())
    all["rotations"] = rotations_of(bodies);
  else
    all["angles"] = angles_of(bodies);
  all["classes"] = classes;
  all["names"] = names;
  all["table"] = packing_text(scene, bodies);
  return all;
}

// The undeformed mesh of a particle class, in its body frame: m.
py::dict mesh_of_class(const LoadedScene& loaded, std::int64_t index) {
  require_particles(loaded);
  const Scene& scene = loaded.scene;
  const std::size_t classes = scene.particles.size() + scene.grains.size();
  if (index < 0 || static_cast<std::size_t>(index) >= classes)
    throw py::index_error(fmt::format("particle: class {}, allowed: 0 to {}", index, classes - 1));
  const int number = static_cast<int>(index);
  if (scene.in_space()) return mesh_in_space(scene, number);
  BodySpec body;
  body.particle = number;
  const ParticleSpec& particle = scene.class_of(body);
  const Shape shape = make_shape(particle);
  py::array_t<std::int32_t> quads({shape.quads.size(), std::size_t{4}});
  for (std::size_t e = 0; e < shape.quads.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      quads.mutable_at(static_cast<py::ssize_t>(e), static_cast<py::ssize_t>(k)) =
          shape.quads[e][k].value;
  py::list grains;  // names of their classes
  for (const auto& tessellation : particle.tessellations)
    for (const GrainPlace& grain : tessellation)
      grains.append(scene.grains[static_cast<std::size_t>(grain.grain)].name);
  py::dict all;
  all["name"] = particle.name;
  all["grains"] = grains;
  all["nodes"] = pairs(shape.nodes);
  all["quads"] = quads;
  all["boundary_nodes"] = shape.boundary_nodes;
  all["area"] = shape.area;
  all["min_corner_sine"] = min_corner_sine(shape);
  all["shortest_edge"] = shortest_edge(shape);
  return all;
}

}  // namespace

void bind_packing(py::module_& core) {
  core.def("packing", &packing_of);
  core.def("mesh_of_class", &mesh_of_class);
}

}  // namespace pulvis::python

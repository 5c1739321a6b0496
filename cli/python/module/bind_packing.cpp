// Packings and meshes alone, without a run.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>

#include "cli/python/module/module.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"

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
                       "an AFM scene has no particles, allowed: a scene of particles"}});
  if (loaded.scene.space)
    throw SceneError({{loaded.scene.file.string(), 1, 1, "", "dimension",
                       "is 3, allowed: 2; packings in three dimensions come from `pulvis pack`, "
                       "meshes from `sim.mesh`"}});
}

// m, rad, names: every particle in the order of its number.
py::dict packing_of(const LoadedScene& loaded) {
  require_particles(loaded);
  std::vector<BodySpec> bodies;
  {
    py::gil_scoped_release others_may_run;
    bodies = place_bodies(loaded.scene);
    check_overlaps(loaded.scene, bodies);
  }
  py::array_t<double> centres({bodies.size(), std::size_t{2}}),
      angles(static_cast<py::ssize_t>(bodies.size()));
  py::array_t<std::int32_t> classes(static_cast<py::ssize_t>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto at = static_cast<py::ssize_t>(i);
    centres.mutable_at(at, 0) = bodies[i].position.x();
    centres.mutable_at(at, 1) = bodies[i].position.y();
    angles.mutable_at(at) = bodies[i].angle;
    classes.mutable_at(at) = bodies[i].particle;
  }
  py::list names;
  for (const ParticleSpec& particle : loaded.scene.particles) names.append(particle.name);
  for (const ParticleSpec& grain : loaded.scene.grains) names.append(grain.name);
  py::dict all;
  all["centres"] = centres;
  all["angles"] = angles;
  all["classes"] = classes;
  all["names"] = names;
  all["table"] = packing_text(loaded.scene, bodies);
  return all;
}

// The undeformed mesh of a class of particles, in its own frame: m.
py::dict mesh_of_class(const LoadedScene& loaded, int number) {
  require_particles(loaded);
  const Scene& scene = loaded.scene;
  if (number < 0 ||
      static_cast<std::size_t>(number) >= scene.particles.size() + scene.grains.size())
    throw py::index_error("there is no class of particles of this number");
  BodySpec body;
  body.particle = number;
  const ParticleSpec& particle = scene.class_of(body);
  const Shape shape = make_shape(particle);
  py::array_t<std::int32_t> quads({shape.quads.size(), std::size_t{4}});
  for (std::size_t e = 0; e < shape.quads.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      quads.mutable_at(static_cast<py::ssize_t>(e), static_cast<py::ssize_t>(k)) =
          shape.quads[e][k].value;
  py::dict all;
  all["name"] = particle.name;
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

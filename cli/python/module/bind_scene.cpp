// Scenes, read by the same parser as on the command line.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <optional>

#include "cli/python/module/interruptible.hpp"
#include "cli/python/module/module.hpp"
#include "cli/save_scene.hpp"
#include "engine/interruption.hpp"
#include "engine/machine_memory.hpp"
#include "scenes/checks/lever_warnings.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/units.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"
#include "scenes/setup_warnings.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

using SharedScene = std::shared_ptr<LoadedScene>;

// Random packings may take a long time.
template <class Read>
SharedScene loaded_by(const Read& read) {
  Interruptible interruptible;
  SharedScene scene;
  bool given_up = false;
  try {
    py::gil_scoped_release others_may_run;
    scene = std::make_shared<LoadedScene>(read());
  } catch (const Interrupted&) {
    given_up = true;
  }
  interruptible.raise_if_asked();
  if (given_up) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return scene;
}

// Those that `check` and `run` tell. Throws SceneError if the scene cannot be built.
std::vector<std::string> warnings(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  if (scene.afm) return lever_warnings(scene);
  std::optional<Simulation> simulation;
  if (memory_need(scene).total() <= available_memory()) simulation.emplace(scene);
  return all_warnings(scene, place_bodies(scene), simulation ? &simulation->world() : nullptr);
}

// Writes into `folder`, with copies of the files it refers to.
void save(const LoadedScene& loaded, const std::string& folder) {
  std::filesystem::create_directories(folder);
  save_scene(folder, loaded);
}

// The scene language as plain data, from which the dataclasses are generated.
py::list declarations() {
  py::list tables;
  for (const schema::TableView& table : schema::scene_language()) {
    py::list keys;
    for (const schema::KeyInfo& key : table.keys) {
      py::dict one;
      one["name"] = key.name;
      one["doc"] = key.doc;
      one["allowed"] = schema::allowed(key);
      one["unit"] = key.unit;
      one["required"] = key.required;
      keys.append(one);
    }
    py::dict one;
    one["path"] = table.info.path;
    one["repeated"] = table.info.repeated;
    one["doc"] = table.info.doc;
    one["families"] = table.info.families.list;
    one["keys"] = keys;
    tables.append(one);
  }
  return tables;
}

}  // namespace

void bind_scene(py::module_& core) {
  py::class_<LoadedScene, SharedScene>(core, "Scene")
      .def_readonly("text", &LoadedScene::text)
      .def_readonly("text_in_place", &LoadedScene::text_in_place)
      .def_property_readonly("hash",
                             [](const LoadedScene& s) { return fmt::format("{:016x}", s.hash); })
      .def_property_readonly("title", [](const LoadedScene& s) { return s.scene.title; })
      .def_property_readonly("file", [](const LoadedScene& s) { return s.scene.file.string(); })
      .def_property_readonly("is_afm", [](const LoadedScene& s) { return s.scene.afm != nullptr; })
      .def("warnings", &warnings, py::call_guard<py::gil_scoped_release>())
      .def("save", &save);
  core.def("load_scene", [](const std::string& file, const std::vector<std::string>& overrides) {
    return loaded_by([&] { return load_scene(file, overrides); });
  });
  core.def("load_scene_text", [](const std::string& text, const std::string& file,
                                 const std::vector<std::string>& overrides) {
    return loaded_by([&] { return load_scene_text(text, file, overrides); });
  });
  core.def("quantity", [](const std::string& text, const std::string& unit) {
    return parse_quantity(text, unit);
  });
  core.def("declarations", &declarations);
}

}  // namespace pulvis::python

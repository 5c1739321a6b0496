#include "cli/preview/preview.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/preview/lever_setup.hpp"
#include "cli/preview/powder_setup.hpp"
#include "cli/preview/scene_check.hpp"
#include "cli/python_scripts/python_scripts.hpp"
#include "cli/tell.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json of_lever(const Scene& scene, SceneFindings& findings) {
  tell_lever_memory(scene);
  const AfmModel model = build_afm(scene);
  findings = findings_of(scene, model);
  return lever_setup(scene, model);
}

// The estimate advances the simulation: the drawing data are taken before it.
json of_powder(const Scene& scene, SceneFindings& findings) {
  const std::vector<BodySpec> particles = place_bodies(scene);
  check_overlaps(scene, particles);
  const MemoryNeed need = require_memory(scene);
  Simulation simulation(scene);
  json setup = powder_setup(scene, particles, simulation.world());
  findings = findings_of(scene, particles, need, &simulation);
  return setup;
}

std::string text_of(const json& setup) {
  return setup.dump(-1, ' ', false, json::error_handler_t::replace);
}

ExitCode draw(const json& setup, const fs::path& output) {
  const ScriptFolder scripts("pulvis/");
  const fs::path file = scripts.path / "setup.json";
  std::ofstream stream(file);
  stream << text_of(setup);
  if (!stream.flush()) throw OutputError(file, "write", std::strerror(errno));
  const int code = run_python(
      {"python3", "-B", (scripts.path / "pulvis/preview/__main__.py").string(),
       "--draw-into=" + scripts.drawn().string(), "--output=" + output.string(), file.string()});
  put_in_place(scripts.drawn());
  return code == 0 ? ExitCode::done : ExitCode::machine;
}

}  // namespace

ExitCode draw_preview(const PreviewOptions& options) {
  const Scene scene = read_scene(options.scene, options.overrides);
  require_another(scene.file, options.output);
  require_own_or_none(options.output, role::figure);
  SceneFindings findings;
  json setup = scene.afm ? of_lever(scene, findings) : of_powder(scene, findings);
  tell_findings(findings);
  setup["title"] = scene.title;
  setup["file"] = scene.file.filename().string();
  setup["warnings"] = findings.warnings;
  setup["run"] = findings.run;
  if (options.output.extension() != ".json") return draw(setup, options.output);
  write_own(options.output, role::figure, text_of(setup));
  tell("{}\n", options.output.string());
  return ExitCode::done;
}

}  // namespace pulvis

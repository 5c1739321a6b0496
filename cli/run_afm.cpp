#include "cli/run_afm.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>

#include "cli/plan.hpp"
#include "cli/summary_afm.hpp"
#include "components/solid.hpp"
#include "engine/output_error.hpp"
#include "engine/recorder.hpp"
#include "engine/run_folder.hpp"
#include "scenes/afm_simulation.hpp"
#include "systems/run_failure.hpp"

namespace pulvis {
namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw OutputError(path, "write", std::strerror(errno));
}

RunMesh mesh_of(const AfmSimulation& simulation) {
  const World& world = const_cast<AfmSimulation&>(simulation).world();
  const auto& solid = world.resource<SolidMesh>();
  const auto& reference = world.column<ReferencePosition>();
  RunMesh mesh;
  for (const auto& hexahedron : solid.hexahedra)
    mesh.hexahedra.insert(mesh.hexahedra.end(), hexahedron.begin(), hexahedron.end());
  mesh.cell_particle.assign(solid.part.begin(), solid.part.end());
  mesh.node_particle.assign(solid.unknown.size(), 0);
  mesh.reference.assign(reference.values(), reference.values() + 3 * solid.unknown.size());
  return mesh;
}

// The lever at rest and under a force normal to the sample, lateral, and along it, each scaled so that
// the tip's end moves by a tenth of the lever's length.
void write_frames(const std::filesystem::path& folder, const LoadedScene& loaded, int threads,
                  AfmSimulation& simulation) {
  const RunMesh mesh = mesh_of(simulation);
  Recorder recorder(folder,
                    {program_version(), program_commit(), loaded.scene.title,
                     fmt::format("{:016x}", loaded.hash), loaded.scene.seed, threads},
                    mesh, {{"tip/displacement", "m", "of the tip's end, as drawn"}},
                    {{"position", "m", "deformed, drawn larger than life", FieldPlace::node, 3},
                     {"displacement", "m", "as drawn", FieldPlace::node, 3}});
  const double drawn = 0.1 * loaded.scene.afm->lever.length;
  const std::array<Vec3, 4> directions{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::vector<double> u = simulation.unit_displacements(directions[i]);
    const double size = read(simulation.model().end, u.data()).norm();
    std::vector<double> x = mesh.reference;
    for (std::size_t k = 0; k < u.size(); ++k) {
      u[k] *= size > 0 ? drawn / size : 0;
      x[k] += u[k];
    }
    recorder.sample(static_cast<double>(i), std::vector<double>{size > 0 ? drawn : 0});
    recorder.frame(static_cast<double>(i), static_cast<std::int64_t>(i), {x, u});
  }
  recorder.finish();
}

}  // namespace

ExitCode run_afm(const LoadedScene& loaded, const std::filesystem::path& folder, int threads,
                 bool overwrite) {
  const auto start = std::chrono::steady_clock::now();
  AfmSimulation simulation(loaded.scene, threads);
  open_run_folder(folder, overwrite);
  write_text(folder / "scene.toml", loaded.text);
  try {
    const Calibration calibration = simulation.calibrate();
    write_frames(folder, loaded, threads, simulation);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write_text(folder / "summary.json",
               afm_summary(loaded, simulation, calibration, {threads, seconds, "done"}));
    fmt::print("{}{} elements, {} nodes, {:.2f} s\nresults in {}\n", calibration_text(calibration),
               simulation.model().elements, simulation.model().nodes, seconds, folder.string());
    return ExitCode::done;
  } catch (const RunFailure& failure) {
    fmt::print(stderr, "pulvis: the run went bad: {}\n", failure.what());
    return ExitCode::run_failed;
  }
}

ExitCode check_afm_scene(const Scene& scene) {
  const AfmModel model = build_afm(scene);
  fmt::print("{}: good: {} elements, {} nodes\n", scene.file.string(), model.elements, model.nodes);
  return ExitCode::done;
}

ExitCode plan_afm(const Scene& scene, bool dot) {
  AfmSimulation simulation(scene);
  fmt::print("{}",
             dot ? plan_dot(simulation.plan()) : plan_text(simulation.plan(), simulation.world()));
  return ExitCode::done;
}

}  // namespace pulvis

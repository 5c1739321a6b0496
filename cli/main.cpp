// The command line: options in, exit code out. What the commands do is in run, plan and report.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <new>

#include "cli/exit_code.hpp"
#include "cli/plan.hpp"
#include "cli/run_afm.hpp"
#include "cli/report.hpp"
#include "cli/run.hpp"
#include "cli/summary.hpp"
#include "engine/instruction_set.hpp"
#include "engine/output_error.hpp"
#include "engine/run_folder.hpp"
#include "scenes/build.hpp"
#include "scenes/describe.hpp"
#include "scenes/grips.hpp"
#include "scenes/place.hpp"
#include "scenes/read.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

struct Options {
  RunOptions run;
  bool dot = false;
  std::string reference;  // scene language: "text" or "schema"
  std::filesystem::path folder;
};

ExitCode check(const Options& options) {
  if (!options.reference.empty()) {
    fmt::print("{}", options.reference == "schema" ? scene_json_schema() : scene_reference());
    return ExitCode::done;
  }
  const Scene scene = read_scene(options.run.scene, options.run.overrides);
  if (scene.afm) return check_afm_scene(scene);
  const std::vector<BodySpec> bodies = place_bodies(scene);
  check_overlaps(scene, bodies);
  if (std::ranges::any_of(scene.tools, is_grip)) build_world(scene);  // it finds their nodes
  fmt::print("{}: good: {} particles, {} tools, {} stages\n", options.run.scene.string(),
             bodies.size(), scene.tools.size(), scene.stages.size());
  return ExitCode::done;
}

ExitCode plan(const Options& options) {
  const Scene scene = read_scene(options.run.scene, options.run.overrides);
  if (scene.afm) return plan_afm(scene, options.dot);
  Simulation simulation(scene);
  fmt::print("{}", options.dot ? plan_dot(simulation.plan())
                               : plan_text(simulation.plan(), simulation.world()));
  return ExitCode::done;
}

ExitCode report(const Options& options) {
  write_report(options.folder);
  fmt::print("{}\n", (options.folder / "report.html").string());
  return ExitCode::done;
}

void add_scene(CLI::App& command, Options& options, bool required = true) {
  auto* scene = command.add_option("scene", options.run.scene, "scene file (TOML)");
  if (required) scene->required();
  command
      .add_option("--set", options.run.overrides,
                  "change a key for this run: key.path=value, e.g. contact.friction=0.2")
      ->allow_extra_args(false)
      ->take_all();
}

int parse_and_run(int argc, char** argv) {
  Options options;
  ExitCode code = ExitCode::done;
  CLI::App app{"Pulvis: combined discrete/finite element method for powders", "pulvis"};
  app.set_version_flag(
      "--version", program_version() + " (" + program_commit() + ", " + instruction_set() + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 2 bad usage, or a scene that was refused; 3 the run went bad, or not "
      "as\n"
      "the scene's [[expect]] tables say; 4 disk or memory; 130 interrupted.");

  auto* run = app.add_subcommand("run", "run a scene and write its results");
  add_scene(*run, options);
  run->add_option("-o,--output", options.run.folder, "results folder (default runs/<scene name>)");
  run->add_option("--threads", options.run.threads, "worker threads (default: all processors)")
      ->check(CLI::Range(1, 1024));
  run->add_flag("--overwrite", options.run.overwrite,
                "replace a run that is already in the folder");
  run->callback([&] { code = run_scene(options.run); });

  auto* checks = app.add_subcommand("check", "read and check a scene without running it");
  add_scene(*checks, options, false);
  checks
      ->add_option("--reference", options.reference,
                   "print the scene language instead: text or schema")
      ->check(CLI::IsMember({"text", "schema"}));
  checks->callback([&] {
    if (options.run.scene.empty() && options.reference.empty()) throw CLI::RequiredError("scene");
    code = check(options);
  });

  auto* plans =
      app.add_subcommand("plan", "print the systems, graph and columns that a scene asks for");
  add_scene(*plans, options);
  plans->add_flag("--dot", options.dot, "the graph as Graphviz input");
  plans->callback([&] { code = plan(options); });

  auto* reports = app.add_subcommand("report", "write report.html anew for a finished run");
  reports->add_option("folder", options.folder, "results folder of a run")->required();
  reports->callback([&] { code = report(options); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(code);
}

int fail(const char* what, ExitCode code) {
  fmt::print(stderr, "{}\n", what);
  return static_cast<int>(code);
}

}  // namespace
}  // namespace pulvis

int main(int argc, char** argv) {
  using namespace pulvis;
  if (!__builtin_cpu_supports("avx2"))
    return fail("pulvis: this build needs a processor with AVX2", ExitCode::machine);
  try {
    return parse_and_run(argc, argv);
  } catch (const SceneError& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const RunFolderTaken& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const OutputError& error) {
    return fail(error.what(), ExitCode::machine);
  } catch (const std::bad_alloc&) {
    return fail("pulvis: out of memory", ExitCode::machine);
  } catch (const std::exception& error) {
    return fail((std::string("pulvis: internal error: ") + error.what()).c_str(),
                ExitCode::machine);
  }
}

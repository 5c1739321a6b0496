// The command line: options in, exit code out. The commands themselves are in run, study, plan, pack,
// reduce and report.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <new>
#include <sstream>
#include <system_error>

#include "cli/campaigns/fit/fit_options.hpp"
#include "cli/campaigns/probe/probe_options.hpp"
#include "cli/campaigns/study/study_options.hpp"
#include "cli/exit_code.hpp"
#include "cli/figure_options.hpp"
#include "cli/interrupt.hpp"
#include "cli/kinds/toml_kind.hpp"
#include "cli/laboratory/output/reduce_options.hpp"
#include "cli/live/live_view.hpp"
#include "cli/live/watch.hpp"
#include "cli/options.hpp"
#include "cli/pack.hpp"
#include "cli/plan.hpp"
#include "cli/preview/preview_options.hpp"
#include "cli/preview/scene_check.hpp"
#include "cli/ranks/join_ranks.hpp"
#include "cli/ranks/launch_ranks.hpp"
#include "cli/report/report.hpp"
#include "cli/session/run.hpp"
#include "cli/session/run_afm.hpp"
#include "cli/setup_progress.hpp"
#include "cli/summary.hpp"
#include "cli/tell.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/instruction_set.hpp"
#include "engine/machine_memory.hpp"
#include "engine/printable.hpp"
#include "engine/shortened.hpp"
#include "scenes/build.hpp"
#include "scenes/keys/scene_reference.hpp"
#include "scenes/language/units.hpp"
#include "scenes/materials/library.hpp"
#include "scenes/read.hpp"
#include "scenes/simulation.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/constraints.hpp"

namespace pulvis {
namespace {

struct Options {
  std::vector<std::string> words;  // of the command line
  int ranks = 1;
  bool live = false;  // show the run in the browser
  int port = 0;       // of that view
  RunOptions run;
  WatchOptions watch;
  StudyOptions study;
  ProbeOptions probe;
  FitOptions fit;
  PreviewOptions preview;
  bool dot = false;
  std::string reference;  // print the scene language: "text", "schema", "materials"
  bool print = false;     // print the complete scene
  FigureOptions figure;
  std::vector<std::filesystem::path> folders;  // of runs to report on
  std::filesystem::path comparison;
  std::filesystem::path packing = "packing.csv";
};

ExitCode print_scene(const LoadedScene& loaded) {
  tell("{}", loaded.text_in_place);
  return ExitCode::done;
}

LoadedScene load_with_progress(const RunOptions& options) {
  const SetupProgress progress;
  return load_scene(options.scene, options.overrides);
}

ExitCode check(const Options& options) {
  if (!options.reference.empty()) {
    tell("{}", options.reference == "schema"      ? scene_json_schema()
               : options.reference == "materials" ? material_reference()
                                                  : scene_reference());
    return ExitCode::done;
  }
  const LoadedScene loaded = load_with_progress(options.run);
  if (options.print) return print_scene(loaded);
  return check_scene(loaded.scene);
}

ExitCode plan(const Options& options) {
  const Scene scene = read_scene(options.run.scene, options.run.overrides);
  if (scene.afm) return plan_afm(scene, options.dot);
  Simulation simulation(scene);
  tell("{}", options.dot
                 ? plan_dot(simulation.plan())
                 : plan_text(simulation.plan(), simulation.sampled_systems(), simulation.world()));
  return ExitCode::done;
}

ExitCode report(const Options& options) {
  for (const auto& folder : options.folders) require_run(folder);
  const auto& run = options.folders.front();
  const bool several = options.folders.size() > 1;
  auto page = options.comparison;
  if (page.empty()) page = several ? "comparison.html" : run / "report.html";
  if (several)
    write_comparison(options.folders, page);
  else
    options.comparison.empty() ? write_report(run) : write_report(run, page);
  tell("{}\n", page.string());
  return ExitCode::done;
}

void add_report(CLI::App& app, Options& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "report", "rewrite report.html of a finished run, or compare several runs side by side");
  command->add_option("folders", options.folders, "results folders of runs")->required();
  command
      ->add_option(
          "-o,--output", options.comparison,
          "the page (default: comparison.html, or report.html in the folder of a single run)")
      ->transform(without_detours);
  command->callback([&] { code = report(options); });
}

void add_scene(CLI::App& command, Options& options, bool required = true) {
  auto* scene = command.add_option("scene", options.run.scene, "scene file (TOML)");
  if (required) scene->required();
  add_overrides(command, options.run.overrides, "this run");
}

// CLI11's own check accepts "nan" and "inf", and its message prints a bound with 309 digits.
template <class Number>
CLI::Validator positive(const char* what) {
  return {[what](const std::string& text) {
            Number value{};
            const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good = read.ec == std::errc() && read.ptr == text.data() + text.size() &&
                              value > 0 && std::isfinite(static_cast<double>(value));
            return good ? std::string() : fmt::format("'{}', allowed: {} > 0", text, what);
          },
          "POSITIVE", "positive"};
}

// Errors found here are reported once, not by every rank.
ExitCode in_ranks(const Options& options, const std::filesystem::path& folder) {
  if (started_by_mpirun()) {
    tell(stderr, "pulvis: --ranks: this process was itself started as a rank, by mpirun or srun\n");
    return ExitCode::usage;
  }
  require_mpi();
  return launch_ranks({own_program(), without_ranks(options.words), options.ranks, folder});
}

void add_ranks(CLI::App& command, Options& options) {
  command
      .add_option("--ranks", options.ranks,
                  "number of MPI processes that share the run (Open MPI); --threads is then per "
                  "process (default: all processors, divided among the processes)")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
}

void add_course(CLI::App& command, RunOptions& options) {
  command.add_flag("--quiet", options.quiet, "print warnings and errors only");
  command.add_flag("--json", options.json,
                   "like --quiet, and print the summary (summary.json) at the end");
  command.add_option("--threads", options.threads, "worker threads (default: all processors)")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--checkpoint-every", options.checkpoints.every,
                  "seconds of wall-clock time between checkpoints")
      ->capture_default_str()
      ->check(positive<double>("seconds"));
  command
      .add_option_function<std::string>(
          "--checkpoint-time",
          [&options](const std::string& text) {
            try {
              options.checkpoints.time = parse_quantity(text, "s");
            } catch (const UnitError& error) {
              throw CLI::ValidationError("--checkpoint-time", error.what());
            }
            if (!(options.checkpoints.time > 0))
              throw CLI::ValidationError("--checkpoint-time", text + ", allowed: > 0 s");
          },
          "additional checkpoints at this interval of simulated time, e.g. \"0.5 ms\"")
      ->type_name("TIME");
  command
      .add_option("--checkpoint-steps", options.checkpoints.steps,
                  "additional checkpoints every so many steps (AFM scenes: increments)")
      ->check(positive<std::int64_t>("a whole number"));
  command
      .add_option("--stop-after", options.checkpoints.stop_after,
                  "stop at this step and write a checkpoint, as on an interrupt (exit code 130)")
      ->check(positive<std::int64_t>("a whole number"));
}

void add_live(CLI::App& command, Options& options) {
  auto* live = command.add_flag(
      "--live", options.live,
      "show the run in the browser while it is under way, at an address that is printed when it "
      "starts; at the end wait until the page has the results");
  add_port(command, options.port)->needs(live);
}

// With a view of it if that is wished; in a run of several processes, of the root.
ExitCode with_view(Options& options, ExitCode (*command)(const RunOptions&)) {
  std::unique_ptr<LiveView> view;
  if (options.live)
    options.run.begun = [&](const std::filesystem::path& folder) {
      view = std::make_unique<LiveView>(folder, options.port);
    };
  return command(options.run);
}

void add_run(CLI::App& app, Options& options, ExitCode& code) {
  auto* run = app.add_subcommand("run", "run a scene and write its results");
  add_scene(*run, options);
  run->add_option("-o,--output", options.run.folder, "results folder (default runs/<scene name>)")
      ->transform(without_detours);
  run->add_flag("--overwrite", options.run.overwrite, "replace an existing run in the folder");
  add_course(*run, options.run);
  add_ranks(*run, options);
  add_live(*run, options);
  run->callback([&options, &code] {
    if (options.ranks == 1) {
      code = with_view(options, run_scene);
      return;
    }
    leave_at_interrupts();
    load_scene(options.run.scene, options.run.overrides);
    code = in_ranks(options, folder_of(options.run));
  });
}

void add_check(CLI::App& app, Options& options, ExitCode& code) {
  auto* checks = app.add_subcommand("check", "read and check a scene without running it");
  add_scene(*checks, options, false);
  checks
      ->add_option(
          "--reference", options.reference,
          "print the reference of the scene language instead: text or schema, or materials "
          "for the material library")
      ->check(CLI::IsMember({"text", "schema", "materials"}));
  checks->add_flag(
      "--print", options.print,
      "print the complete scene instead, with extended files, overrides and defaults filled in");
  checks->callback([&options, &code] {
    if (options.run.scene.empty() && options.reference.empty()) throw CLI::RequiredError("scene");
    code = check(options);
  });
}

void add_resume(CLI::App& app, Options& options, ExitCode& code) {
  auto* resume = app.add_subcommand(
      "resume", "continue a run that was stopped or killed, from its last checkpoint");
  resume->add_option("folder", options.run.folder, "results folder of the run")->required();
  add_course(*resume, options.run);
  add_ranks(*resume, options);
  add_live(*resume, options);
  resume->callback([&options, &code] {
    code =
        options.ranks == 1 ? with_view(options, resume_run) : in_ranks(options, options.run.folder);
  });
}

// A first word that is not a command: `pulvis rnu`.
bool refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  if (std::ranges::find(commands, argv[1]) != commands.end()) return false;
  tell(stderr, "pulvis: there is no command '{}'{}, allowed: {}; see pulvis --help\n",
       printable(shortened(argv[1])), suggestion(argv[1], commands), listed(commands));
  return true;
}

// If a command refuses a TOML file of another kind, its own errors would mislead.
std::string explained(const SceneError& error, int argc, char** argv) {
  for (int i = 2; i < argc; ++i)
    if (std::filesystem::path(argv[i]).extension() == ".toml")
      if (const auto other = other_kind(argv[1], argv[i])) return *other;
  return error.what();
}

// The results of these commands are files; what they print is a log.
bool prints_a_log(const CLI::App& app, const Options& options) {
  for (const char* command : {"run", "resume", "study", "probe", "fit"})
    if (app.got_subcommand(command)) return !options.run.json;
  return false;
}

// Prints help, or the errors on the command line.
int tell_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  tell("{}", out.str());
  constexpr std::size_t longest = 4000;  // it quotes what was given
  const std::string text = err.str();
  tell(stderr, "{}{}", shortened(text, longest), text.size() > longest ? "\n" : "");
  return code == 0 ? end_output(0, false) : static_cast<int>(ExitCode::usage);
}

int parse_and_run(int argc, char** argv) {
  Options options;
  options.words.assign(argv + 1, argv + argc);
  ExitCode code = ExitCode::done;
  CLI::App app{"Pulvis: combined discrete/finite element method for powders", "pulvis"};
  app.set_version_flag(
      "--version", program_version() + " (" + program_commit() + ", " + instruction_set() + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 success; 2 wrong usage, or the scene was refused; 3 the run failed or did not "
      "meet\nthe scene's [[expect]] tables; 4 disk or memory error; 130 interrupted, see resume.");

  add_run(app, options, code);
  add_resume(app, options, code);
  add_study(app, options.study, code);
  add_probe(app, options.probe, code);
  add_fit(app, options.fit, code);
  for (const std::string name : {"study", "probe", "fit"})
    app.get_subcommand(name)->preparse_callback([name](std::size_t) {
      if (started_as_rank())
        throw CLI::ValidationError(
            name, "cannot be one of several ranks of mpirun or srun: it starts runs of its own");
    });

  add_check(app, options, code);
  add_preview(app, options.preview, code);

  auto* plans = app.add_subcommand("plan", "print the systems, task graph and columns of a scene");
  add_scene(*plans, options);
  plans->add_flag("--dot", options.dot, "print the task graph as Graphviz input");
  plans->callback([&] { code = plan(options); });

  auto* packs = app.add_subcommand(
      "pack", "generate the packing of a scene and write it as a table for kind = \"csv\"");
  add_scene(*packs, options);
  packs->add_option("-o,--output", options.packing, "output table (CSV, default packing.csv)")
      ->transform(without_detours);
  packs->callback([&] {
    code = pack_scene(read_scene(options.run.scene, options.run.overrides), options.packing);
  });

  add_watch(app, options.watch, code);
  add_report(app, options, code);
  add_figure(app, options.figure, code);

  ReduceCommand reduce_command;
  add_reduce(app, reduce_command, code);

  if (refuse_unknown_command(app, argc, argv)) return static_cast<int>(ExitCode::usage);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return tell_usage(app, error);
  }
  return end_output(static_cast<int>(code), prints_a_log(app, options));
}

int fail(const char* what, ExitCode code) {
  if (*what != '\0') tell(stderr, "{}\n", what);  // only one of several ranks reports
  return static_cast<int>(code);
}

}  // namespace
}  // namespace pulvis

int main(int argc, char** argv) {
  using namespace pulvis;
  prepare_standard_streams();
  if (!__builtin_cpu_supports("avx2"))
    return fail("pulvis: this build needs a processor with AVX2", ExitCode::machine);
  try {
    return parse_and_run(argc, argv);
  } catch (const SceneError& error) {
    return fail(explained(error, argc, argv).c_str(), ExitCode::usage);
  } catch (const RunFolderTaken& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const ForeignFile& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const CannotResume& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const NotARun& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const UnlikeRanks& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const NoMpi& error) {
    return fail(error.what(), ExitCode::machine);
  } catch (const OutputError& error) {
    return fail(error.what(), ExitCode::machine);
  } catch (const std::system_error& error) {
    return fail((std::string("pulvis: ") + error.what()).c_str(), ExitCode::machine);
  } catch (const std::bad_alloc&) {
    return fail("pulvis: out of memory", ExitCode::machine);
  } catch (const std::exception& error) {
    return fail((std::string("pulvis: internal error: ") + error.what()).c_str(),
                ExitCode::machine);
  }
}

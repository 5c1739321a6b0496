#include "cli/laboratory/output/reduce_options.hpp"

#include "cli/laboratory/lab_settings.hpp"
#include "cli/tell.hpp"

namespace pulvis {
namespace {

ExitCode reduce(const ReduceCommand& command) {
  if (command.reference.empty()) return reduce_records(command.options);
  tell("{}", command.reference == "schema" ? lab::json_schema() : lab::reference());
  return ExitCode::done;
}

}  // namespace

void add_reduce(CLI::App& app, ReduceCommand& command, ExitCode& code) {
  ReduceOptions& options = command.options;
  auto* reduces = app.add_subcommand(
      "reduce",
      "reduce raw records of sliding-plate friction tests, "
      "compressions, or an AFM's friction loops on slopes, to curves, values and a report");
  reduces->add_option("files", options.files,
                      "records (CSV) of press and data logger, identified by their columns and "
                      "paired in order; or one file of an AFM's friction loops; settings (.toml)");
  reduces
      ->add_option("--set", options.overrides,
                   "set a key of the settings: key.path=value, e.g. \"compact.length=10 mm\"")
      ->allow_extra_args(false)
      ->take_all();
  reduces
      ->add_option("--simulation", options.simulations,
                   "run folder of a simulated test to draw over the measured curves")
      ->allow_extra_args(false)
      ->take_all();
  reduces->add_option("-o,--output", options.folder, "results folder")
      ->capture_default_str()
      ->transform(without_detours);
  reduces->add_flag("--overwrite", options.overwrite, "replace results in the folder");
  reduces->add_option("--reference", command.reference, "print the settings' reference instead")
      ->check(CLI::IsMember({"text", "schema"}));
  reduces->footer(
      "Sliding-plate tests: the compact's length and Poisson's ratio (or its powder) must be "
      "given.\n"
      "  pulvis reduce press-1.csv logger-1.csv press-2.csv logger-2.csv \\\n"
      "      --set \"compact.length=10 mm\" --set compact.powder=316L -o reduced\n"
      "Compression curves: the settings name the records, masses and heights.\n"
      "  pulvis reduce scenes/lab/press.toml -o pressed\n"
      "Friction loops on known slopes (columns slope, load, and half_width, offset or "
      "raw\n"
      "columns trace and retrace, in volts): friction coefficient and sensitivity of the lateral "
      "detector.\n"
      "  pulvis reduce loops.csv --set \"wedge.slope_error=0.2 deg\" -o wedge\n"
      "From an AFM's volts to friction: settings that name force curves, loops and the lever.\n"
      "  pulvis reduce scenes/lab/volts.toml -o volts\n"
      "File formats, equations and how each value is determined: docs/laboratory.md; all "
      "settings:\n"
      "docs/reduce.md, or --reference text.");
  reduces->callback([&] {
    if (options.files.empty() && command.reference.empty()) throw CLI::RequiredError("files");
    code = reduce(command);
  });
}

}  // namespace pulvis

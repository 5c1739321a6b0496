#include "cli/campaigns/fit/fit_options.hpp"

#include "cli/campaigns/fit/plate_fit.hpp"
#include "cli/tell.hpp"

namespace pulvis {

void add_fit(CLI::App& app, FitOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "fit",
      "calibrate the friction so that a simulated sliding-plate test reproduces a measured one");
  command->add_option("fit", options.fit, "fit file (TOML), docs/fit.md");
  command
      ->add_option("-o,--output", options.folder,
                   "results folder (default runs/<fit name>); finished runs in it are kept")
      ->transform(without_detours);
  command
      ->add_option("--jobs", options.jobs,
                   "number of concurrent runs, one thread each (default: the number of processors)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--fresh", options.fresh, "run everything again");
  command
      ->add_option("--reference", options.reference,
                   "print the reference of the fit file instead: text")
      ->check(CLI::IsMember({"text"}));
  add_overrides(*command, options.overrides, "every run");
  command->callback([&options, &code] {
    if (options.fit.empty() && options.reference.empty()) throw CLI::RequiredError("fit");
    if (options.reference.empty())
      code = run_fit(options);
    else
      tell("{}", plate_fit_reference());
  });
}

}  // namespace pulvis

#include "cli/campaigns/probe/probe_options.hpp"

#include "cli/campaigns/probe/probe_read.hpp"
#include "cli/tell.hpp"

namespace pulvis {

void add_probe(CLI::App& app, ProbeOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "probe", "find the yield surface of a powder at given densities and fit cap models to it");
  command->add_option("probe", options.probe, "probe file (TOML), docs/probe.md");
  command
      ->add_option("-o,--output", options.folder,
                   "results folder (default runs/<probe name>); finished runs in it are kept")
      ->transform(without_detours);
  command
      ->add_option("--jobs", options.jobs,
                   "number of concurrent runs, one thread each (default: the number of processors)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--fresh", options.fresh, "run everything again");
  command->add_flag("--list", options.list,
                    "check everything and print the runs without running them");
  command
      ->add_option("--reference", options.reference,
                   "print the reference of the probe file instead: text")
      ->check(CLI::IsMember({"text"}));
  add_overrides(*command, options.overrides, "the scene of every path");
  command->callback([&options, &code] {
    if (options.probe.empty() && options.reference.empty()) throw CLI::RequiredError("probe");
    if (options.reference.empty())
      code = run_probe(options);
    else
      tell("{}", probe_reference());
  });
}

}  // namespace pulvis

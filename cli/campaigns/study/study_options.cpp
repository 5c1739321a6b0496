#include "cli/campaigns/study/study_options.hpp"

#include "cli/campaigns/study/study_read.hpp"
#include "cli/tell.hpp"

namespace pulvis {
namespace {

constexpr const char* slurm_group = "On a cluster with Slurm (docs/cluster.md)";

// Text that is inserted verbatim into a line of the script.
const CLI::Validator one_line(
    [](const std::string& text) {
      const bool good = !text.empty() && printable(text) == text;
      return good ? std::string() : "'" + printable(text) + "': allowed: text without line breaks";
    },
    "", "one_line");

const CLI::Validator time_limit(
    [](const std::string& text) {
      return time_limit_seconds(text)
                 ? std::string()
                 : "'" + printable(text) + "' is not a time limit, allowed: " + time_limit_forms;
    },
    "", "time_limit");

// Whether sbatch (getopt_long) reads the word as an option that tells a task its runs, its folder or its processors. It takes
// abbreviated long options, values attached to short ones, and short ones in front of them that have no value.
bool is_own_option(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (name.starts_with("--")) {
    for (const std::string own : {"--array", "--chdir", "--cpus-per-task"})
      if (own.starts_with(name)) return true;
    return false;
  }
  const std::size_t letter = word.find_first_not_of("hHOQsuvVW", 1);
  return letter != std::string::npos && std::string("aDc").find(word[letter]) != std::string::npos;
}

// Options that the study sets may not be set by users.
const CLI::Validator other_option(
    [](const std::string& text) {
      if (!text.starts_with('-') || text == "-" || text == "--")
        return "'" + text + "': allowed: an option, e.g. --account=powders";
      return is_own_option(text) ? "'" + text + "' is set by the study itself" : std::string();
    },
    "", "other_option");

void add_slurm(CLI::App& command, SlurmOptions& options) {
  auto* slurm = command.add_flag(
      "--slurm", options.submit,
      "submit the remaining runs as an array job instead of running them; --jobs then limits the "
      "number of concurrent tasks, --threads-per-run sets the processors per task (default 1)");
  const auto belongs = [&](CLI::Option* option) {
    return option->needs(slurm)->group(slurm_group);
  };
  slurm->group(slurm_group);
  belongs(command.add_flag("--dry-run", options.dry_run,
                           "print the job script and the command that submits it; change nothing"));
  belongs(command.add_option("--partition", options.partition,
                             "partition (default: that of the cluster)"))
      ->check(one_line);
  belongs(
      command.add_option("--time", options.time,
                         "time limit of a task, e.g. 30 (minutes), 1:30:00 or 2-12 (days-hours); "
                         "shortly before it, runs stop with a checkpoint and are requeued"))
      ->check(time_limit)
      ->type_name("TIME");
  belongs(
      command.add_option(
          "--array-size", options.array_size,
          "maximum number of tasks; if there are more runs, they are distributed over the tasks"))
      ->capture_default_str()
      ->check(CLI::Range(1, 4'000'000));
  belongs(command.add_option(
              "--sbatch", options.more,
              "another option of sbatch, e.g. --sbatch=--account=powders; may be repeated"))
      ->allow_extra_args(false)
      ->take_all()
      ->check(one_line)
      ->check(other_option)
      ->type_name("OPTION");
  for (const char* const local : {"--fresh", "--list", "--gather"})
    slurm->excludes(command.get_option(local));
}

void add_course_of_study(CLI::App& command, StudyOptions& options) {
  command
      .add_option("--jobs", options.jobs,
                  "number of concurrent runs (default: as many as the processors allow)")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--threads-per-run", options.threads,
                  "threads per run (default: one, more if there are fewer runs than processors)")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--run", options.only,
                  "run only the run of this name, without the study's table; may be repeated")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("NAME");
  auto* fresh =
      command.add_flag("--fresh", options.fresh,
                       "rerun everything from the start, including finished and interrupted runs");
  command.add_flag("--list", options.list,
                   "check everything and print the runs without running them");
  command
      .add_flag("--gather", options.gather,
                "run nothing; write table and report of the finished runs")
      ->excludes(fresh);
}

}  // namespace

void add_study(CLI::App& app, StudyOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "study", "run variations of a scene; table, curves and trends in one report");
  command->add_option("study", options.study, "study file (TOML), docs/study.md");
  command
      ->add_option("-o,--output", options.folder,
                   "results folder (default runs/<study name>); finished runs in it are kept")
      ->transform(without_detours);
  add_course_of_study(*command, options);
  command
      ->add_option("--reference", options.reference,
                   "print the reference of the study file instead: text")
      ->check(CLI::IsMember({"text"}));
  add_overrides(*command, options.overrides, "every run");
  add_slurm(*command, options.slurm);
  command->callback([&options, &code] {
    if (options.study.empty() && options.reference.empty()) throw CLI::RequiredError("study");
    if (options.reference.empty())
      code = run_study(options);
    else
      tell("{}", study_reference());
  });
}

}  // namespace pulvis

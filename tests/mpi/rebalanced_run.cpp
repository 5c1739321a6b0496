// pulvis run and pulvis resume over ranks whose chunks migrate again and again, whatever their steps take:
//
//   mpirun -np N rebalanced_run EVERY run SCENE FOLDER STOP THREADS [KEY=VALUE...]
//   mpirun -np N rebalanced_run EVERY resume FOLDER STOP
//
// Until it is resumed, the root writes all files, as it does on NFS. Every so many steps each chunk costs another number of 1 to 7, which the step and the chunk alone say.
#include <cstdlib>
#include <exception>
#include <string>

#include "cli/session/run.hpp"
#include "cli/tell.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

std::vector<double> shaken_costs(std::int64_t step, int chunks) {
  std::vector<double> costs;
  for (int chunk = 0; chunk < chunks; ++chunk) {
    auto mixed = static_cast<std::uint64_t>(step) * 0x9e3779b97f4a7c15 +
                 static_cast<std::uint64_t>(chunk) * 0xbf58476d1ce4e5b9;
    mixed = (mixed ^ mixed >> 31) * 0x94d049bb133111eb;
    costs.push_back(1 + static_cast<double>((mixed >> 33) % 7));
  }
  return costs;
}

ExitCode run(const std::vector<std::string>& words) {
  const bool begins = words.at(1) == "run";
  const std::size_t folder = begins ? 3 : 2;
  RunOptions options;
  options.quiet = true;
  options.folder = words.at(folder);
  options.checkpoints.steps = 1'000'000'000;
  options.checkpoints.stop_after = std::stoll(words.at(folder + 1));
  options.threads = begins ? std::stoi(words.at(5)) : 1;
  options.before_steps = [&](Simulation& simulation) {
    if (begins) simulation.write_from_root();
    if (simulation.balance() != nullptr)
      simulation.balance()->follow(std::stoll(words.at(0)), shaken_costs);
  };
  if (!begins) return resume_run(options);
  options.scene = words.at(2);
  options.overrides.assign(words.begin() + 6, words.end());
  return run_scene(options);
}

}  // namespace
}  // namespace pulvis

int main(int count, char** words) {
  try {
    return static_cast<int>(pulvis::run({words + 1, words + count}));
  } catch (const std::exception& error) {
    pulvis::tell(stderr, "rebalanced_run: {}\n", error.what());
    return EXIT_FAILURE;
  }
}

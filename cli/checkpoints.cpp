#include "cli/checkpoints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "cli/summary.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr int run_over_cost = 100;  // a checkpoint may cost at most a hundredth of the run

std::string hash_text(const LoadedScene& scene) { return fmt::format("{:016x}", scene.hash); }

std::string run_of(const fs::path& folder) {
  const auto file = hdf5::File::open(folder / "run.h5");
  return file.has_attribute("/", "run") ? file.text_attribute("/", "run") : "";
}

bool is_finished(const fs::path& folder) {
  const auto file = hdf5::File::open(folder / "run.h5");
  return file.has_attribute("/", "outcome") && file.text_attribute("/", "outcome") == "done";
}

std::unique_ptr<Checkpoint> newest_whole(const fs::path& folder) {
  const std::vector<fs::path> files = checkpoints_in(folder);
  const std::string run = run_of(folder);
  bool is_any_damaged = false;
  for (const fs::path& file : files) {
    try {
      auto found = std::make_unique<Checkpoint>(file);
      if (found->info().run == run) return found;
    } catch (const OtherFormat& other) {
      throw CannotResume(
          fmt::format("{}: cannot resume: {}: {}", folder.string(), file.string(), other.what()));
    } catch (const DamagedCheckpoint& damage) {
      tell(stderr, "pulvis: {} is damaged: {}\n", file.string(), damage.what());
      is_any_damaged = true;
    }
  }
  if (files.empty() && is_finished(folder))
    throw CannotResume(fmt::format(
        "{}: cannot resume: the run is finished, allowed: one that was stopped", folder.string()));
  if (is_any_damaged) throw OutputError(folder, "resume", "there is no intact checkpoint");
  throw CannotResume(fmt::format(
      "{}: cannot resume: there is no checkpoint{} (checkpoint-*.h5)", folder.string(),
      files.empty() ? "" : " of the run that wrote this run.h5, only those of other runs"));
}

void check_version(const fs::path& folder, const CheckpointInfo& info) {
  if (info.version == program_version() && info.commit == program_commit()) return;
  throw CannotResume(
      fmt::format("{}: cannot resume: the checkpoint was written by pulvis {} ({}), but this is {} "
                  "({}), which could give different results; allowed: the program that wrote it",
                  folder.string(), info.version, info.commit, program_version(), program_commit()));
}

LoadedScene scene_of(const fs::path& folder, const Checkpoint& checkpoint) {
  LoadedScene scene = load_scene(folder / "scene.toml");
  if (hash_text(scene) != checkpoint.info().scene_hash)
    throw CannotResume(
        fmt::format("{}: cannot resume: the checkpoint belongs to another scene (its hash is {}, "
                    "that of scene.toml and the files it names is {})",
                    folder.string(), checkpoint.info().scene_hash, hash_text(scene)));
  return scene;
}

}  // namespace

Checkpoints::Checkpoints(const LoadedScene& scene, fs::path folder,
                         const CheckpointOptions& options)
    : info_{.version = program_version(),
            .commit = program_commit(),
            .scene_hash = hash_text(scene),
            .powder_hash = fmt::format("{:016x}", scene.powder_hash)},
      folder_(std::move(folder)),
      options_(options) {}

bool Checkpoints::due(std::int64_t step, double time) const {
  if (step == last_step_) return false;
  if (last_step_ < 0) return true;
  if (options_.time > 0 &&
      std::floor(time / options_.time) > std::floor(info_.time / options_.time))
    return true;
  if (options_.steps > 0 && step % options_.steps == 0) return true;
  const auto since = Time::now() - last_;
  return since >= std::chrono::duration<double>(options_.every) && since >= run_over_cost * cost_;
}

template <class Write>
void Checkpoints::written(std::int64_t step, double time, const Write& write) {
  const auto begin = Time::now();
  info_.step = step;
  info_.time = time;
  write();
  last_step_ = step;
  last_ = Time::now();
  cost_ = last_ - begin;
}

void Checkpoints::write(std::int64_t step, double time, const StateParts& world,
                        const StateParts& run) {
  written(step, time, [&] { write_checkpoint(folder_, info_, world, run); });
}

void Checkpoints::write(std::int64_t step, double time, const World& world, const StateParts& run,
                        const ColumnVisit& visit) {
  written(step, time, [&] { write_checkpoint(folder_, info_, world, run, visit); });
}

void Checkpoints::keep_state(const std::string& name, std::int64_t step, double time,
                             const World& world, const ColumnVisit& visit) const {
  CheckpointInfo info = info_;
  info.step = step;
  info.time = time;
  write_state_file(folder_ / fmt::format("state-{}.h5", name), info, world, visit);
}

void require_stopped_run(const fs::path& folder) {
  if (!fs::exists(folder / "scene.toml") || !fs::exists(folder / "run.h5"))
    throw CannotResume(
        fmt::format("{}: cannot resume: there is no run (run.h5, scene.toml)", folder.string()));
}

StoppedRun find_stopped_run(const fs::path& folder) {
  StoppedRun run;
  run.checkpoint = newest_whole(folder);
  check_version(folder, run.checkpoint->info());
  run.scene = scene_of(folder, *run.checkpoint);
  return run;
}

void clear_other_checkpoints(const fs::path& folder, const std::string& run) {
  remove_unfinished_checkpoints(folder);
  for (const fs::path& file : checkpoints_in(folder)) {
    try {
      if (Checkpoint(file).info().run != run) remove_own(file, role::run);
    } catch (const DamagedCheckpoint&) {  // has been reported already
    }
  }
}

bool can_go_on(const fs::path& folder, std::uint64_t scene_hash) {
  try {
    require_stopped_run(folder);
    return find_stopped_run(folder).scene.hash == scene_hash;
  } catch (const CannotResume&) {
  } catch (const OutputError&) {  // there is no intact checkpoint
  } catch (const SceneError&) {   // scene.toml has been changed
  }
  return false;
}

}  // namespace pulvis

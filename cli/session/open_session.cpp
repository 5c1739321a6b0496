#include "cli/session/open_session.hpp"

#include <fmt/format.h>

#include "cli/save_scene.hpp"
#include "cli/tell.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/memory_need.hpp"

namespace pulvis {
namespace {

std::unique_ptr<FolderLock> locked_new(const std::filesystem::path& folder, bool overwrite) {
  return std::unique_ptr<FolderLock>(new FolderLock(open_run_folder(folder, overwrite)));
}

}  // namespace

void require_free_folder(const LoadedScene& loaded, const std::filesystem::path& folder) {
  require_not_read(folder, loaded.scene.file);
  for (const InputFile& input : loaded.inputs) require_not_read(folder, input.source);
  require_own_files(folder);
}

void whole_or_nothing(const std::filesystem::path& folder, const std::function<void()>& begin) {
  try {
    begin();
  } catch (const ForeignFile&) {
    remove_own_below(folder, role::run);
    throw;
  } catch (const RunFolderTaken&) {
    throw;
  } catch (const OutputError& error) {
    remove_own_below(folder, role::run);
    throw OutputError(error.path(), error.operation(),
                      error.reason() +
                          "; nothing was kept: once the cause is fixed, start the run "
                          "again in the same way");
  }
}

OpenSession open_session(const LoadedScene& loaded, const Session::Options& options, bool overwrite,
                         const std::function<void()>& before_writing) {
  if (!options.folder.empty()) require_free_folder(loaded, options.folder);
  require_memory(loaded.scene, machines_of(options.ranks));
  Ranks* ranks = options.ranks != nullptr ? &options.ranks->tell(loaded) : nullptr;
  auto simulation = std::make_unique<Simulation>(loaded.scene, options.threads, ranks);
  if (before_writing) before_writing();
  OpenSession open;
  if (options.folder.empty()) {
    open.session = std::make_unique<Session>(loaded, options, std::move(simulation));
  } else {
    open.lock = locked_new(options.folder, overwrite);
    whole_or_nothing(options.folder, [&] {
      save_scene(options.folder, loaded);
      open.session = std::make_unique<Session>(as_saved(options.folder, loaded), options,
                                               std::move(simulation));
      open.session->begin();
    });
    return open;
  }
  open.session->begin();
  return open;
}

namespace {

// A run goes on without what is lost of a frame, but not without its mesh or its history. Frames since the checkpoint
// are computed anew, and images at the end.
void look_for_damage(const std::filesystem::path& results, const CheckpointInfo& from) {
  constexpr const char* found = "its bytes are not those that were written: the checksum differs";
  const hdf5::File file = hdf5::File::open(results);
  for (const std::string& dataset : file.damaged_datasets()) {
    if (dataset.starts_with("/images/")) continue;
    if (!dataset.starts_with("/frames/"))
      throw OutputError(results, "continue",
                        fmt::format("{}: {}; it is lost, and the run needs it: allowed are a copy "
                                    "of the file, or a new run",
                                    dataset, found));
    const std::size_t end = dataset.find('/', std::string_view("/frames/").size());
    const std::string frame = dataset.substr(0, end);
    if (file.number_attribute(frame, "step") > static_cast<double>(from.step)) continue;
    tell(stderr,
         "warning: {}: {}: {}; '{}' is lost for the frame at t = {:.6g} s, the run goes on without "
         "it\n",
         results.string(), dataset, found, dataset.substr(end + 1),
         file.number_attribute(frame, "time"));
  }
}

}  // namespace

OpenFolder open_stopped(const std::filesystem::path& folder, bool driven_too) {
  require_stopped_run(folder);
  OpenFolder open{std::make_unique<FolderLock>(folder), {}};
  require_own_results(folder);
  hdf5::File::open_to_change(folder / "run.h5").close();  // repairs it after a power failure
  open.run = find_stopped_run(folder);
  look_for_damage(folder / "run.h5", open.run.checkpoint->info());
  const std::vector<std::string> driven = driven_in(*open.run.checkpoint);
  if (!driven_too && !driven.empty())
    throw CannotResume(
        fmt::format("{}: cannot resume: the run was driven from Python ({}) and can only be "
                    "continued there; allowed: pulvis.resume(\"{}\") in Python",
                    folder.string(), listed(driven), folder.string()));
  clear_other_checkpoints(folder, open.run.checkpoint->info().run);
  return open;
}

}  // namespace pulvis

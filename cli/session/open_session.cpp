#include "cli/session/open_session.hpp"

#include <fmt/format.h>

#include "cli/save_scene.hpp"
#include "engine/files/hdf5.hpp"
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
    save_scene(options.folder, loaded);
    open.session =
        std::make_unique<Session>(as_saved(options.folder, loaded), options, std::move(simulation));
  }
  open.session->begin();
  return open;
}

OpenFolder open_stopped(const std::filesystem::path& folder, bool driven_too) {
  require_stopped_run(folder);
  OpenFolder open{std::make_unique<FolderLock>(folder), {}};
  require_own_results(folder);
  hdf5::File::open_to_change(folder / "run.h5").close();  // repairs it after a power failure
  open.run = find_stopped_run(folder);
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

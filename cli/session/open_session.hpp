// A session with its folder: what has to be checked, and in which order, before the first file is written.
#pragma once

#include <functional>
#include <memory>

#include "cli/session/session.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {

struct OpenSession {
  std::unique_ptr<FolderLock> lock;  // null without a folder
  std::unique_ptr<Session> session;
};

// At the start of a scene of particles. Everything that can be refused is refused before the folder is created and
// before memory is allocated. `before_writing` is called when both checks have passed.
OpenSession open_session(const LoadedScene& loaded, const Session::Options& options, bool overwrite,
                         const std::function<void()>& before_writing = {});
// The checks common to all families, before that.
void require_free_folder(const LoadedScene& loaded, const std::filesystem::path& folder);

// Calls `begin`, which writes the first files of a run. If the disk is full, they are removed, and the same command can
// be given again.
void whole_or_nothing(const std::filesystem::path& folder, const std::function<void()>& begin);

// The folder of a stopped run, locked and repaired.
struct OpenFolder {
  std::unique_ptr<FolderLock> lock;
  StoppedRun run;
};
// Throws CannotResume; `driven_too`: also accepts runs that were driven from outside.
OpenFolder open_stopped(const std::filesystem::path& folder, bool driven_too);

}  // namespace pulvis

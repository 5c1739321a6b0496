// A session with its folder: what has to be looked at, and in which order, before the first file is written.
#pragma once

#include <functional>
#include <memory>

#include "cli/session/session.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {

struct OpenSession {
  std::unique_ptr<FolderLock> lock;  // none without a folder
  std::unique_ptr<Session> session;
};

// At the beginning of a scene of particles. Everything that can be refused is refused before the folder is made, and
// before memory is taken. `before_writing` is called when both are good.
OpenSession open_session(const LoadedScene& loaded, const Session::Options& options, bool overwrite,
                         const std::function<void()>& before_writing = {});
// The refusals for whatever family, before that.
void require_free_folder(const LoadedScene& loaded, const std::filesystem::path& folder);

// A folder whose run stopped, locked and repaired.
struct OpenFolder {
  std::unique_ptr<FolderLock> lock;
  StoppedRun run;
};
// Throws CannotResume; `driven_too`: also what was driven from outside goes on.
OpenFolder open_stopped(const std::filesystem::path& folder, bool driven_too);

}  // namespace pulvis

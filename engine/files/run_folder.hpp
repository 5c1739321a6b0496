// The folder a run writes into: made, or refused, before anything else is written.
#pragma once

#include <filesystem>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis {

// The folder already holds a run, and the caller did not say it may be replaced.
class RunFolderTaken : public OutputError {
 public:
  using OutputError::OutputError;
};

// While it lives, no other process gets a lock of the same folder; it goes with the process, however that
// ends, and leaves no file behind. A file system that knows no locks gives one to everybody.
class FolderLock {
 public:
  // Throws RunFolderTaken; `taken` says by whom.
  explicit FolderLock(const std::filesystem::path& folder,
                      const char* taken = "another run is writing into it");

 private:
  FileDescriptor folder_;
};

// Whether some process has such a lock now; false of a folder that is not there. Who takes one at that very moment is
// refused: ask only about folders in which nothing is about to start.
bool is_locked(const std::filesystem::path& folder);

// Makes the folder, parents included, and checks that files can be written into it. One that holds a file where
// the run will write its own, and that no run wrote, is refused (ForeignFile: engine/files/own_files.hpp), and one with
// results of a run unless `overwrite`. Then the old run's own files (run.h5, run.xdmf, history.csv, summary.json,
// report.html, scene.toml, checkpoint-*.h5, state-*.h5, what `figure` drew in pictures/) go and others stay. A refusal
// leaves everything as it was: what this call made is taken away again.
FolderLock open_run_folder(const std::filesystem::path& folder, bool overwrite = false);
// Only that: made, parents included, and files can be written into it.
void make_results_folder(const std::filesystem::path& folder);
// The first half of that refusal.
void require_own_files(const std::filesystem::path& folder);
// Only what a run that goes on writes anew.
void require_own_results(const std::filesystem::path& folder);
// None of a run's files there is `read`, by whatever path it is reached.
void require_not_read(const std::filesystem::path& folder, const std::filesystem::path& read);

}  // namespace pulvis

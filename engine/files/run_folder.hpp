// The output folder of a run: created, or refused, before anything else is written.
#pragma once

#include <filesystem>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis {

// The folder already holds a run, and the caller did not allow replacing it.
class RunFolderTaken : public OutputError {
 public:
  using OutputError::OutputError;
};

// As long as it exists, no other process gets a lock of the same folder; it ends with the process, however that
// ends, and leaves no file behind. A file system without locks grants one to everybody.
class FolderLock {
 public:
  // Throws RunFolderTaken; `taken` names the holder.
  explicit FolderLock(const std::filesystem::path& folder,
                      const char* taken = "another run is writing into it");

 private:
  FileDescriptor folder_;
};

// Whether some process holds such a lock now; false for a missing folder. Asking refuses no process its lock.
bool is_locked(const std::filesystem::path& folder);

// Creates the folder, including parents, and checks that files can be written into it. A folder with a file where
// the run will write one, but that no run wrote, is refused (ForeignFile: engine/files/own_files.hpp), so is one with
// results of a run unless `overwrite`. Then the old run's own files (run.h5, run.xdmf, run.vtkhdf, tools.vtkhdf, history.csv,
// summary.json, report.html, scene.toml, checkpoint-*.h5, state-*.h5, what `figure` drew in pictures/) are removed, others stay. A
// refusal leaves everything as it was: whatever this call created is removed again.
FolderLock open_run_folder(const std::filesystem::path& folder, bool overwrite = false);
// Only that part: created, including parents, and files can be written into it.
void make_results_folder(const std::filesystem::path& folder);
// Refuses (ForeignFile) a folder that has other files where the run will write.
void require_own_files(const std::filesystem::path& folder);
// Checks only the files that a continued run rewrites.
void require_own_results(const std::filesystem::path& folder);
// Checks that none of the run's output files is `read`, by whatever path it is reached.
void require_not_read(const std::filesystem::path& folder, const std::filesystem::path& read);

}  // namespace pulvis

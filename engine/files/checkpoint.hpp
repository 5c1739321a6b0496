// Checkpoints: the complete state of a run in one file, from which it continues as if it had never stopped.
//
// <folder>/checkpoint-000000001234.h5, where the number is the step; state-<stage>.h5, written at the end of a stage:
//   512 bytes of text       "pulvis checkpoint", size and XXH3 of everything that follows (HDF5's user block)
//   /                       version, commit, scene_hash, powder_hash, run, step, time
//   /columns/<place>/<name> bytes of every column that is not transient
//   /resources/<name>       bytes of every resource that is not fixed
//   /run/<name>             bytes of the other data the run needs to continue
//
// A file is written under a temporary name, flushed to disk and only then renamed, so that a
// checkpoint is either complete or absent. Nothing in a file is trusted before its checksum has been
// verified: whatever happened to it, HDF5 never sees a damaged one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "engine/files/shared_file.hpp"
#include "engine/world.hpp"

namespace pulvis {

struct CheckpointInfo {
  std::string version, commit, scene_hash;
  std::int64_t step = 0;
  double time = 0;
  std::string run = {};  // the attribute of its run.h5
  std::string powder_hash = {};
};

using StateParts = std::map<std::string, std::vector<std::byte>>;

// What a checkpoint of `world` would contain, by name: kept in memory, to be written later.
StateParts state_of(const World& world);

// For a world whose columns are elsewhere. `write` is asked first for every column: it may write the column itself, into the
// room that is made for its bytes, and returns whether it did; `flush` is called after the last one. Other columns are
// written here, between calls of `fetch` and `leave`.
struct ColumnVisit {
  using MakeRoom = std::function<FileRoom(std::uint64_t bytes)>;
  std::function<bool(const ColumnBase&, const MakeRoom&)> write;
  std::function<void()> flush;
  std::function<void(const ColumnBase&)> fetch, leave;
};

// Afterwards the folder holds this checkpoint and the previous one, but no older ones of this run.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointInfo& info,
                      const World& world, const StateParts& run, const ColumnVisit& visit = {});
void write_checkpoint(const std::filesystem::path& folder, const CheckpointInfo& info,
                      const StateParts& world, const StateParts& run);

// The same as a state from which other runs may start; replaces an old one of that name.
void write_state_file(const std::filesystem::path& file, const CheckpointInfo& info,
                      const World& world, const ColumnVisit& visit = {});

// Newest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder,
                                                  const char* ending = ".h5");
// All those written by Pulvis, from any run; also partial files left by a killed program.
void remove_checkpoints(const std::filesystem::path& folder);
void remove_unfinished_checkpoints(const std::filesystem::path& folder);

// The file is not as written: truncated, modified, or not a checkpoint at all.
class DamagedCheckpoint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Written by an earlier version of the program.
class OtherFormat : public DamagedCheckpoint {
 public:
  using DamagedCheckpoint::DamagedCheckpoint;
};

// Whether a restored world takes the column from its file. `left_alone`: names as in "node/position".
bool is_restored(const ColumnBase& column, const std::set<std::string>& left_alone);

class Checkpoint {
 public:
  explicit Checkpoint(const std::filesystem::path& file);  // throws DamagedCheckpoint
  // Another process has just read it as a Checkpoint: its checksum is not computed again.
  static Checkpoint verified(const std::filesystem::path& file);

  const CheckpointInfo& info() const { return info_; }
  const std::filesystem::path& file() const { return file_.path(); }
  // `world` must be built from the same scene. Throws BadState if it has other columns or resources; those in `left_alone`
  // are not changed.
  void restore(World& world, const std::set<std::string>& left_alone = {}) const;
  // Bytes of one column or resource by its name in the file: "node/position", "clock".
  bool has_column(const std::string& name) const { return file_.contains("/columns/" + name); }
  std::vector<std::byte> column(const std::string& name) const;
  std::uint64_t column_bytes(const std::string& name) const;
  std::vector<std::byte> column(const std::string& name, std::uint64_t first,
                                std::uint64_t bytes) const;
  std::vector<std::byte> resource(const std::string& name) const;
  // Throws BadState if `world` has other columns or resources, apart from those in `left_alone`.
  void require_same_parts(const World& world, const std::set<std::string>& left_alone = {}) const;
  std::vector<std::byte> run(const std::string& name) const;
  bool has_run(const std::string& name) const { return file_.contains("/run/" + name); }

 private:
  explicit Checkpoint(hdf5::File file);
  hdf5::File file_;
  CheckpointInfo info_;
};

}  // namespace pulvis

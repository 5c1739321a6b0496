// Checkpoints: the whole state of a run in one file, from which it goes on as if it had never stopped.
//
// <folder>/checkpoint-000000001234.h5, the number is the step; state-<stage>.h5, kept at the end of a stage:
//   512 bytes of text       "pulvis checkpoint", size and XXH3 of all that follows (HDF5's user block)
//   /                       version, commit, scene_hash, powder_hash, run, step, time
//   /columns/<place>/<name> bytes of every column that is not transient
//   /resources/<name>       bytes of every resource that is not fixed
//   /run/<name>             bytes of what else the run carries on
//
// A file is written under another name, brought to the disk and only then given its own, so that a
// checkpoint is there as a whole or not at all. Nothing of a file is believed before its checksum has been
// found right: whatever happened to it, HDF5 never sees a damaged one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"
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

// What a checkpoint would hold of `world`, by its name there: kept in memory, to be written later.
StateParts state_of(const World& world);

// Afterwards the folder holds this checkpoint and the one before, no older ones of this run.
// `fetch` is called with every column before it is written, and `leave` after it: of a world that holds one at a time.
struct ColumnVisit {
  std::function<void(const ColumnBase&)> fetch, leave;
};
void write_checkpoint(const std::filesystem::path& folder, const CheckpointInfo& info,
                      const World& world, const StateParts& run, const ColumnVisit& visit = {});
void write_checkpoint(const std::filesystem::path& folder, const CheckpointInfo& info,
                      const StateParts& world, const StateParts& run);

// The same as a state that other runs may begin with; an old one of that name goes.
void write_state_file(const std::filesystem::path& file, const CheckpointInfo& info,
                      const World& world, const ColumnVisit& visit = {});

// The newest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder,
                                                  const char* ending = ".h5");
// Those of Pulvis's own, whatever run they are of; halves that a killed program left, too.
void remove_checkpoints(const std::filesystem::path& folder);
void remove_unfinished_checkpoints(const std::filesystem::path& folder);

// It is not what was written: cut short, changed, or no checkpoint at all.
class DamagedCheckpoint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An earlier version of the program wrote it.
class OtherFormat : public DamagedCheckpoint {
 public:
  using DamagedCheckpoint::DamagedCheckpoint;
};

class Checkpoint {
 public:
  explicit Checkpoint(const std::filesystem::path& file);  // throws DamagedCheckpoint

  const CheckpointInfo& info() const { return info_; }
  const std::filesystem::path& file() const { return file_.path(); }
  // `world` was made from the same scene. Throws BadState where it has other columns or resources; those of `left_alone` stay
  // as they are.
  void restore(World& world, const std::set<std::string>& left_alone = {}) const;
  // Bytes of one column or resource by its name here: "node/position", "clock".
  bool has_column(const std::string& name) const { return file_.contains("/columns/" + name); }
  std::vector<std::byte> column(const std::string& name) const;
  std::vector<std::byte> resource(const std::string& name) const;
  // Throws BadState where `world` has other columns or resources, apart from resources of `left_alone`.
  void require_same_parts(const World& world, const std::set<std::string>& left_alone = {}) const;
  std::vector<std::byte> run(const std::string& name) const;
  bool has_run(const std::string& name) const { return file_.contains("/run/" + name); }

 private:
  hdf5::File file_;
  CheckpointInfo info_;
};

}  // namespace pulvis

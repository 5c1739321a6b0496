// What the ranks write of a run's files: each the rows of its own particles, straight into the file, where the root has made
// room for them. Every function is collective, and throws OutputError on the root if a rank failed.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/files/record.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"
#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

class SharedOutput {
 public:
  explicit SharedOutput(World& share);

  // On the root: whether the ranks can write into files of this folder.
  bool can_write_in(const std::filesystem::path& folder) const;
  void leave_to_root() { is_left_to_root_ = true; }
  // A field of the mesh.
  void field(const ParticleValues& values, const FieldRoom& room);
  // Column number `column` (of World::columns), of an entity divided by chunks or of contact rows.
  void column(std::size_t column, const FileRoom& room);
  // What was written, to disk.
  void flush();

 private:
  template <class Action>
  void attempt(const Action& action);
  SharedFile& opened(const std::string& file);
  void flush_own();

  World& share_;
  Ranks& ranks_;
  bool is_on_one_machine_, is_left_to_root_ = false;
  std::optional<SharedFile> file_;
};

}  // namespace pulvis

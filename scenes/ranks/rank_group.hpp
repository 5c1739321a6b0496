// The ranks of a run and their root. The root drives the simulation, and announces every call to the others, which
// follow. Only the root produces results: it has a second world, of the whole scene, into which the necessary data are
// fetched, and which uses memory only while results are written.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/checkpoint.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"
#include "scenes/ranks/balance.hpp"
#include "scenes/ranks/gather.hpp"
#include "scenes/ranks/shared_output.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// What the root orders the others to do.
struct Command {
  enum class Kind {
    run,      // to a time
    observe,  // and fetch
    move,
    fetch,         // columns, index of rows
    particles,     // values of a field of the mesh, or of what the state's hash covers
    write_field,   // of the mesh, into the run's file
    write_column,  // into a checkpoint
    flush,         // what was written, to disk
    total,         // what the ranks sent and used
    restore,
    leave
  };
  Kind kind = Kind::leave;
  double time = 0;                       // s
  std::vector<std::uint64_t> columns{};  // indices in World::columns
  bool rows = false;                     // their index
  std::string file{};                    // a checkpoint
  std::uint64_t field = 0;               // of mesh_values; past them: of hashed_values
  FieldRoom room{};                      // in a file, for what is written

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(kind, time, columns, rows, file, field, room);
  }
};

class RankGroup {
 public:
  // `whole`: on the root, from build_whole_world. `fields`: of the mesh. `hashed`: hashed_values.
  RankGroup(World& share, std::unique_ptr<World> whole, const Scene& scene,
            std::vector<ParticleValues> fields, std::vector<ParticleValues> hashed);
  ~RankGroup();  // on the root it tells the others to leave; collective

  bool leads() const { return ranks_.is_root(); }
  // From the root to all.
  void tell(Command command);
  // On the others.
  Command listen();
  // What follows a step: the root's decision, on all ranks.
  enum class Next : std::uint8_t { step, balance, stop };
  Next next(bool root_stops);
  Balance& balance() { return balance_; }

  // A rank's part in a fetch.
  void fetch(const Command& command);
  void total();
  void visit_particles(const Command& command, const ValueSink& take = {});
  void write(const Command& command);
  // What this rank has sent in all; `ran` adds steps and the bytes sent in them.
  std::uint64_t bytes_sent() const { return ranks_.bytes_sent(); }
  void ran(std::int64_t steps, std::uint64_t bytes) {
    steps_ += steps;
    bytes_ += static_cast<std::int64_t>(bytes);
  }

  // ---- only on the root
  World& whole() { return *whole_; }
  // `looks`: what the observers of the whole world read.
  Command fetch_sample(const std::vector<std::string>& looks) const;
  Command fetch_rows() const;  // index of the rows, for a checkpoint
  Command fetch_start() const;
  Command hashed(std::size_t number) const;  // of hashed_values
  // Whether the ranks write a field of a frame into files in this folder.
  bool writes_field_in(const std::filesystem::path& folder, std::size_t field) const {
    return field < fields_ && output_.can_write_in(folder);
  }
  void write_from_root() { output_.leave_to_root(); }
  // Bytes of a column of the whole that the ranks write into a checkpoint in this folder; nothing: it must be fetched.
  std::optional<std::uint64_t> bytes_written_in(const std::filesystem::path& folder,
                                                const ColumnBase& column) const;
  // Restores what was last found in the whole, valid until the next search.
  void restore_findings(const Checkpoint& checkpoint);
  // Frees the memory of fetched data, except for small columns.
  void drop();
  void drop(const ColumnBase& column);
  std::size_t number_of(const ColumnBase& column) const;
  // bytes, peak of each rank; known likewise.
  const std::vector<double>& memory() const { return memory_; }
  double bytes_a_step() const {  // all ranks together; known after `total`
    return steps_ > 0 ? static_cast<double>(bytes_of_all_) / static_cast<double>(steps_) : 0;
  }

 private:
  std::vector<std::uint64_t> numbers_of(const std::vector<std::string>& names) const;

  World& share_;
  std::unique_ptr<World> whole_;
  Ranks& ranks_;
  std::vector<ParticleValues> values_;  // of fields, then hashed_values
  std::size_t fields_;
  Balance balance_;
  SharedOutput output_;
  // What results read at every sample: the nodes, what touches tools, and the force on a round die.
  bool needs_motion_, needs_tool_rows_, needs_die_wall_;
  std::int64_t steps_ = 0, bytes_ = 0, bytes_of_all_ = 0;
  std::vector<double> memory_;
};

// Throws SceneError if the scene has something that a run over several ranks does not support.
void require_ranks_can_run(const Scene& scene);

}  // namespace pulvis

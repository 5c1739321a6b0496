// A run over several ranks: the root runs it like any other, and sends the scene to the others; they follow.
#pragma once

#include "cli/exit_code.hpp"
#include "engine/ranks/ranks.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/ranks/rank_group.hpp"
#include "scenes/read.hpp"

namespace pulvis {

// On the root, before it builds its simulation of the scene.
void tell_scene(Ranks& ranks, const LoadedScene& loaded);
// Called instead if it has refused to run.
void tell_nothing(Ranks& ranks);

// On the others: builds the scene sent by the root, and follows it to its end.
ExitCode follow_root(Ranks& ranks, int threads);

// The root's control of the other ranks. If it leaves before it has sent them a scene, nobody waits for it.
class LedRanks {
 public:
  LedRanks(Ranks& ranks, std::vector<MachineMemory> machines)
      : ranks_(ranks), machines_(std::move(machines)) {}
  ~LedRanks() {
    if (!told_) tell_nothing(ranks_);
  }
  LedRanks(const LedRanks&) = delete;
  LedRanks& operator=(const LedRanks&) = delete;
  // Throws SceneError if the scene has something that a run over ranks does not support.
  Ranks& tell(const LoadedScene& loaded) {
    require_ranks_can_run(loaded.scene);
    told_ = true;
    tell_scene(ranks_, loaded);
    return ranks_;
  }

  const std::vector<MachineMemory>& machines() const { return machines_; }

 private:
  Ranks& ranks_;
  std::vector<MachineMemory> machines_;
  bool told_ = false;
};

// Of a run; `ranks`: null for one process.
inline std::vector<MachineMemory> machines_of(const LedRanks* ranks) {
  return ranks != nullptr ? ranks->machines() : std::vector{MachineMemory()};
}

}  // namespace pulvis

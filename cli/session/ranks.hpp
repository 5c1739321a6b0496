// A run over several ranks: the root runs it like any other, and tells the others which scene it is; they follow.
#pragma once

#include "cli/exit_code.hpp"
#include "engine/ranks/ranks.hpp"
#include "scenes/ranks/crew.hpp"
#include "scenes/read.hpp"

namespace pulvis {

// On the root, before it builds its simulation of the scene.
void tell_scene(Ranks& ranks, const LoadedScene& loaded);
// Instead, where it has refused to run.
void tell_nothing(Ranks& ranks);

// On the others: builds what the root tells, and follows it to its end.
ExitCode follow_root(Ranks& ranks, int threads);

// The root's hold on the others. If it leaves before it has told them a scene, nobody waits for it.
class LedRanks {
 public:
  explicit LedRanks(Ranks& ranks) : ranks_(ranks) {}
  ~LedRanks() {
    if (!told_) tell_nothing(ranks_);
  }
  LedRanks(const LedRanks&) = delete;
  LedRanks& operator=(const LedRanks&) = delete;
  // Throws SceneError where a run over ranks cannot have what is in the scene.
  Ranks& tell(const LoadedScene& loaded) {
    require_ranks_can_run(loaded.scene);
    told_ = true;
    tell_scene(ranks_, loaded);
    return ranks_;
  }

 private:
  Ranks& ranks_;
  bool told_ = false;
};

}  // namespace pulvis

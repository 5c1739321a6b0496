#include "cli/session/ranks.hpp"

#include <cstring>
#include <string>

#include "cli/tell.hpp"
#include "engine/state_bytes.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

struct Told {
  bool runs = false;
  std::string text, file;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(runs, text, file);
  }
};

void broadcast(Ranks& ranks, Told told) {
  StateWriter writer;
  told.state(writer);
  Ranks::Bytes bytes = writer.bytes();
  ranks.broadcast(bytes);
}

Told heard(Ranks& ranks) {
  Ranks::Bytes bytes;
  ranks.broadcast(bytes);
  Told told;
  StateReader reader(bytes);
  told.state(reader);
  return told;
}

}  // namespace

void tell_scene(Ranks& ranks, const LoadedScene& loaded) {
  broadcast(ranks, {true, loaded.text_in_place,
                    std::filesystem::absolute(loaded.scene.file).string()});
}
void tell_nothing(Ranks& ranks) { broadcast(ranks, {}); }

ExitCode follow_root(Ranks& ranks, int threads) {
  const Told told = heard(ranks);
  if (!told.runs) return ExitCode::done;
  try {
    Simulation(load_scene_text(told.text, told.file).scene, threads, &ranks).follow();
  } catch (const std::exception& error) {  // the root does not know of it
    tell(stderr, "pulvis: rank {}: {}\n", ranks.rank(), error.what());
    ranks.abort(static_cast<int>(ExitCode::machine));
  }
  return ExitCode::done;
}

}  // namespace pulvis

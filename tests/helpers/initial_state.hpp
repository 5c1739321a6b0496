// Runs that begin with the state of another run.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "engine/files/checkpoint.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {

class InitialState : public testing::Test {
 protected:
  InitialState() { std::filesystem::create_directories(folder); }
  ~InitialState() override { std::filesystem::remove_all(folder); }

  // The scene `before` + `first`, run to its end, whose state is kept.
  std::unique_ptr<Experiment> kept(const std::string& before, const std::string& first) const {
    const LoadedScene loading = load_scene_text(before + first, folder / "loading.toml");
    auto part = std::make_unique<Experiment>(loading.scene);
    part->run(10);
    CheckpointInfo info;
    info.powder_hash = fmt::format("{:016x}", loading.powder_hash);
    write_state_file(folder / "state.h5", info, part->simulation.world());
    return part;
  }
  // The scene `before` + `second`, from the kept state.
  Experiment gone_on(const std::string& before, const std::string& second) const {
    return Experiment(
        load_scene_text("initial_state = \"state.h5\"\n" + before + second, folder / "rest.toml")
            .scene);
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("pulvis-state-{}", getpid());
};

}  // namespace pulvis

#include "targets.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "engine/checkpoint.hpp"
#include "engine/journaled_file.hpp"
#include "engine/output_error.hpp"
#include "scenes/csv_table.hpp"
#include "scenes/lab_settings.hpp"
#include "scenes/packing_file.hpp"
#include "scenes/read.hpp"
#include "scenes/study_read.hpp"
#include "scenes/target_shape.hpp"

namespace pulvis::fuzz {
namespace {

namespace fs = std::filesystem;
using Input = std::span<const std::uint8_t>;

std::string text_of(Input input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

// A folder of this process; the last input stays in it after a crash.
fs::path own_folder() {
  static const fs::path folder = [] {
    const fs::path made = fs::temp_directory_path() / ("pulvis-fuzz-" + std::to_string(getpid()));
    fs::create_directories(made);
    std::atexit([] {
      std::error_code ignored;
      fs::remove_all(fs::temp_directory_path() / ("pulvis-fuzz-" + std::to_string(getpid())),
                     ignored);
    });
    return made;
  }();
  return folder;
}

fs::path file_of(Input input, const char* name) {
  const fs::path file = own_folder() / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text_of(input);
  return file;
}

// Filling a die takes seconds by right: without random packings.
bool takes_long(const std::string& text) { return text.find("random") != std::string::npos; }

void scene(Input input) {
  const std::string text = text_of(input);
  if (takes_long(text)) return;
  try {
    load_scene_text(text, own_folder() / "scene.toml");
  } catch (const SceneError&) {
  }
}

void study(Input input) {
  if (takes_long(text_of(input))) return;
  std::ofstream(own_folder() / "base.toml", std::ios::trunc) << "family = \"compaction\"\n";
  try {
    load_study(file_of(input, "study.toml"));
  } catch (const SceneError&) {
  }
}

void settings(Input input) {
  try {
    lab::load_settings_text(text_of(input), own_folder() / "settings.toml", {});
  } catch (const SceneError&) {
  }
}

void table(Input input) {
  try {
    const csv::Table table = csv::read_text(text_of(input), "table.csv");
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      try {
        csv::numbers(table, column, "m");
      } catch (const SceneError&) {
      }
    }
  } catch (const SceneError&) {
  }
}

void height_map(Input input) {
  const fs::path file = file_of(input, "map.csv");
  try {
    read_height_map(file, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::runtime_error&) {
  }
}

void packing(Input input) {
  Scene scene;
  scene.particles.resize(2);
  scene.particles[0].name = "disc";
  scene.particles[1].name = "grain";
  try {
    read_packing(file_of(input, "packing.csv"), scene);
  } catch (const SceneError&) {
  }
}

void state(Input input) {
  const auto bytes = std::as_bytes(input);
  const auto attempt = [&](auto object) {
    try {
      set_state(object, bytes);
    } catch (const BadState&) {
    }
  };
  attempt(ToolProgram());
  attempt(ContactIndex());
  attempt(ContactNetwork());
}

void checkpoint(Input input) {
  const fs::path file = file_of(input, "checkpoint-000000000001.h5");
  try {
    World world;
    Checkpoint(file).restore(world);
  } catch (const DamagedCheckpoint&) {
  } catch (const BadState&) {
  }
}

void journal(Input input) {
  const fs::path file = own_folder() / "run.h5";
  std::ofstream(file, std::ios::binary | std::ios::trunc) << std::string(9000, 'x');
  file_of(input, "run.h5.journal");
  JournaledFile(file, JournaledFile::Open::existing).close();
}

constexpr std::array all{
    Target{"scene", scene}, Target{"study", study},           Target{"settings", settings},
    Target{"table", table}, Target{"packing", packing},       Target{"height_map", height_map},
    Target{"state", state}, Target{"checkpoint", checkpoint}, Target{"journal", journal}};

}  // namespace

std::span<const Target> targets() { return all; }

}  // namespace pulvis::fuzz

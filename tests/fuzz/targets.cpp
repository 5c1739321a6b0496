#include "targets.hpp"
#include "scenes/outlines/points_file.hpp"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "cli/campaigns/study/study_read.hpp"
#include "cli/laboratory/lab_record.hpp"
#include "cli/laboratory/lab_settings.hpp"
#include "cli/laboratory/volts/volts_records.hpp"
#include "cli/laboratory/wedge_records.hpp"
#include "components/bond.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "engine/files/checkpoint.hpp"
#include "engine/files/journaled_file.hpp"
#include "engine/files/output_error.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"
#include "scenes/lever/target_shape.hpp"
#include "scenes/outlines/outline_checks.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/size_law.hpp"
#include "scenes/read.hpp"
#include "scenes/tools/profile_file.hpp"

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

// What was not refused can be computed with: a reader that lets NaN through has let the user down.
void must(bool holds) {
  if (!holds) std::abort();
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

void must_be_sound(const GmshSolid& solid) {
  for (const Vec3& x : solid.nodes) must(x.allFinite());
  const auto inside = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (const auto n : nodes) must(n >= 0 && static_cast<std::size_t>(n) < solid.nodes.size());
  };
  inside(solid.hexahedra);
  inside(solid.tetrahedra);
}

// A meshed tip as Gmsh writes it, up to the solid it becomes.
void mesh(Input input) {
  Scene scene;
  scene.file = own_folder() / "scene.toml";
  scene.afm = std::make_shared<AfmScene>();
  scene.afm->tip.shape = TipSpec::Shape::mesh;
  scene.afm->tip.file = file_of(input, "tip.msh").filename();
  scene.afm->tip.unit = 1e-6;
  Problems problems(scene.file, {});
  load_meshed_tip(scene, {}, problems);
  if (scene.afm->tip.solid == nullptr) return;
  const TipSolid& tip = *scene.afm->tip.solid;
  must(tip.height > 0 && tip.reach > 0);
  must_be_sound(tip.solid);
}

// A meshed lever, the same way.
void lever(Input input) {
  Scene scene;
  scene.file = own_folder() / "scene.toml";
  scene.afm = std::make_shared<AfmScene>();
  scene.afm->lever.shape = LeverSpec::Shape::mesh;
  scene.afm->lever.file = file_of(input, "lever.msh").filename();
  scene.afm->lever.unit = 1e-6;
  Problems problems(scene.file, {});
  load_meshed_lever(scene, {}, problems);
  if (scene.afm->lever.solid == nullptr) return;
  const LeverSolid& solid = *scene.afm->lever.solid;
  must(solid.length > 0 && solid.thickness > 0);
  must_be_sound(solid.solid);
  for (const LeverSide* side : {&solid.face, &solid.back})
    for (const int n : side->node)
      must(n >= 0 && static_cast<std::size_t>(n) < solid.solid.nodes.size());
}

template <class Read>
void refused_or_read(const Read& read) {
  try {
    read();
  } catch (const SceneError&) {
  }
}

// What scenes take from files of two columns: profiles of walls, sieve curves, traced outlines.
void curve(Input input) {
  const fs::path file = file_of(input, "curve.csv");
  refused_or_read([&] {
    for (const Vec2& p : read_profile(file)) must(p.allFinite());
  });
  refused_or_read([&] {
    const SieveCurve sieve = read_sieve_curve(file);
    must(sieve.size() >= 2);
    SizeLaw law;
    law.kind = SizeLaw::Kind::sieve;
    for (const SizeShare& s : sizes_of(law, sieve, 3))
      must(std::isfinite(s.size) && s.size > 0 && std::isfinite(s.share));
  });
  PointsOutline outline;
  outline.file = file.filename();
  outline.smoothing = 1e-9;
  if (!read_points(file.parent_path(), outline).empty()) return;
  for (const Vec2& p : outline.points) must(p.allFinite());
}

// Records of instruments: a press, a data logger, friction loops of an AFM.
void record(Input input) {
  static const lab::Settings settings =
      lab::load_settings({}, {"compact.length=10 mm", "compact.powder=316L"}).settings;
  const fs::path file = file_of(input, "record.csv");
  refused_or_read([&] { lab::instrument_of(file, settings); });
  refused_or_read([&] { lab::read_press(file, settings); });
  refused_or_read([&] { lab::read_logger(file, settings); });
  if (wedge::holds_loops(file)) refused_or_read([&] { wedge::read_loops(file, 0.1); });
  refused_or_read([&] { volts::read_loops(file, false, 0.1); });
  refused_or_read([&] {
    for (const volts::ForceCurve& curve : volts::read_curves(file, "normal")) try {
        volts::figures_of(curve, {0.3, 0.25, 0.95, true});
      } catch (const std::runtime_error&) {
      }
  });
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
  attempt(ContactNetwork<TwoD>());
  attempt(BondTotals());
  attempt(Fragments());
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
    Target{"scene", scene},    Target{"study", study},     Target{"settings", settings},
    Target{"table", table},    Target{"packing", packing}, Target{"height_map", height_map},
    Target{"mesh", mesh},      Target{"lever", lever},     Target{"curve", curve},
    Target{"record", record},  Target{"state", state},     Target{"checkpoint", checkpoint},
    Target{"journal", journal}};

}  // namespace

std::span<const Target> targets() { return all; }

}  // namespace pulvis::fuzz

// Every key of the scene language goes through save, check, stop, resume, report and figure; the scenes are
// generated from the declarations (key_plan.hpp).
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "cli/campaigns/study/declare_study.hpp"
#include "cli/campaigns/study/saved_settings.hpp"
#include "cli/campaigns/study/study_read.hpp"
#include "engine/files/checkpoint.hpp"
#include "engine/files/own_files.hpp"
#include "plan_checks.hpp"
#include "scenes/build.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/lever/afm_build.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "tests/helpers/left.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;

// The scenes, and the states that some of them begin with: made anew, since they are good for one powder as this program
// packs it.
class Bases {
 public:
  const fs::path folder =
      fs::temp_directory_path() / ("pulvis-keys-of-scenes-" + std::to_string(getpid()));
  const fs::path plane = folder / "plane", space = folder / "space";

  Bases() {
    fs::create_directories(folder);
    const fs::path given = fs::path(paths::source_dir()) / "tests" / "keys";
    for (const auto& [from, to] : {std::pair{"scenes", plane}, {"scenes-3d", space}})
      fs::copy(given / from, to,
               fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    keep_first_stage(plane, "cell.toml");
    keep_first_stage(space, "kept.toml");
    keep_first_stage(space, "cell.toml", "state-cell.h5");
  }
  static void keep_first_stage(const fs::path& folder, const char* scene,
                               const char* state = "state-press.h5") {
    const LoadedScene loaded = load_scene(folder / scene);
    Simulation simulation(loaded.scene);
    simulation.run_until(loaded.scene.stages.front().duration);
    CheckpointInfo info;
    info.powder_hash = fmt::format("{:016x}", loaded.powder_hash);
    write_state_file(folder / "data" / state, info, simulation.world());
  }
  Bases(const Bases&) = delete;
  Bases& operator=(const Bases&) = delete;
  ~Bases() { fs::remove_all(folder); }
};

const Bases& bases() {
  static const Bases made;
  return made;
}

// What `pulvis check` says of a scene of this text among the bases.
std::string fault_of_scene(const std::string& text, const fs::path& folder) {
  return fault_in([&] {
    const Scene scene = load_scene_text(text, folder / "case.toml").scene;
    if (scene.afm)
      build_afm(scene);
    else
      check_overlaps(scene, place_bodies(scene));
  });
}

const Plan& plan() {
  static const Plan made = plan_or_fault(schema::scene_language(2), bases().plane, fault_of_scene);
  return made;
}

const Plan& plan_in_space() {
  static const Plan made = [] {
    Plan all = plan_or_fault(schema::scene_language(3), bases().space, fault_of_scene);
    std::erase_if(all.missing, [](const Use& use) {
      return use.text() == "family = \"afm\"";  // levers have no dimension
    });
    return all;
  }();
  return made;
}

TEST(KeysOfScenes, AreAllUsed) { expect_all_used(plan(), "scene", "tests/keys/scenes"); }

TEST(KeysOfScenes, AreAllUsedInSpace) {
  expect_all_used(plan_in_space(), "scene in three dimensions", "tests/keys/scenes-3d");
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> cases = plan().cases;
    for (Case one : plan_in_space().cases) {
      one.name = "space_" + one.name;
      cases.push_back(std::move(one));
    }
    return cases;
  }();
  return all;
}

std::string kind_of(const Scene& scene) {
  if (!scene.afm) return scene.bonds.empty() ? "powder" : "bonds";
  const auto rasters = [](const ActionSpec& action) {
    return action.kind == ActionSpec::Kind::raster;
  };
  if (std::ranges::any_of(scene.afm->actions, rasters)) return "raster";
  return scene.afm->actions.empty() ? "lever" : "programme";
}

// Python takes its time: the first case of every kind of run.
const std::set<std::string>& drawn() {
  static const std::set<std::string> names = [] {
    std::map<std::string, std::string> first;
    for (const Case& one : plan().cases)
      first.try_emplace(kind_of(load_scene_text(one.text, bases().plane / "case.toml").scene),
                        one.name);
    std::set<std::string> all;
    for (const auto& [kind, name] : first) all.insert(name);
    return all;
  }();
  return names;
}

class SceneKeys : public ProgramTest, public ::testing::WithParamInterface<Case> {
 protected:
  const fs::path sources = "scènes of a user", whole = "whole", moved = "où ça – a folder, moved";

  void SetUp() override {
    ProgramTest::SetUp();
    fs::copy(GetParam().base.parent_path(), place / sources, fs::copy_options::recursive);
    std::ofstream(place / sources / "case.toml") << GetParam().text;
  }

  // Ends as it should and says nothing about it, except for what --quiet says: warnings of coarse meshes, and on a slow
  // machine that it is still at work.
  void expect_quiet(const Words& words) const {
    const Outcome outcome = pulvis(words);
    EXPECT_EQ(outcome.code, 0) << words.front() << ": " << outcome.err << outcome.out;
    std::istringstream told(outcome.err);
    for (std::string line; std::getline(told, line);)
      EXPECT_TRUE(line.starts_with("warning: ") || line.starts_with("pulvis: preparing the scene"))
          << words.front() << ": " << line;
  }

  std::int64_t steps() const {
    const auto summary = nlohmann::json::parse(text_of(place / whole / "summary.json"));
    return summary.contains("steps") ? summary.at("steps") : summary.at("increments");
  }

  // The first step, the last but one, some in between, and where a stage, an action or a raster's line ends.
  std::vector<std::int64_t> stops(const Scene& scene) const {
    const std::int64_t all = steps();
    std::set<std::int64_t> at{1, all / 3, all / 2, all - 1};
    double time = 0, end = 0;
    for (const StageSpec& stage : scene.stages) end += stage.duration;
    for (const StageSpec& stage : scene.stages)
      at.insert(
          static_cast<std::int64_t>((time += stage.duration) / end * static_cast<double>(all)));
    std::int64_t done = 0;
    if (scene.afm)
      for (const ActionSpec& action : scene.afm->actions) {
        if (action.kind == ActionSpec::Kind::raster) at.insert(done + 2 * action.increments);
        at.insert(done += static_cast<std::int64_t>(action.samples()));
      }
    std::erase_if(at, [&](std::int64_t step) { return step < 1 || step >= all; });
    return {at.begin(), at.end()};
  }

  // Saved once, the scene stays what it is, also without the files it was read from.
  void expect_saved(const LoadedScene& given) const {
    const fs::path saved = place / whole / "scene.toml";
    EXPECT_EQ(text_of(saved), given.text);
    const LoadedScene again = load_scene(saved);
    EXPECT_EQ(again.text, given.text);
    EXPECT_EQ(again.hash, given.hash);
    expect_quiet({"check", (whole / "scene.toml").string()});
  }

  // Of its systems: a resumed run counts its parts before, too.
  double cost() const {
    const auto summary = nlohmann::json::parse(text_of(place / moved / "summary.json"));
    double seconds = 0;
    if (summary.contains("cost"))
      for (const auto& system : summary.at("cost")) seconds += system.at("seconds").get<double>();
    return seconds;
  }

  void run_in_parts(const std::vector<std::int64_t>& stops) const {
    Words words{"run", (sources / "case.toml").string(), "-o", "parts"};
    constexpr double rounded_up = 1 + 1e-9;  // sums in another order
    double before = 0;
    for (const std::int64_t step : stops) {
      Words part = words;
      part.insert(part.end(), {"--threads", "1", "--stop-after", std::to_string(step)});
      const Outcome stopped = pulvis(part);
      ASSERT_EQ(stopped.code, 130) << "stop at step " << step << ": " << stopped.err;
      if (words.front() == "run") {
        fs::rename(place / "parts", place / moved);
        fs::remove_all(place / sources);
      }
      words = {"resume", moved.string()};
      EXPECT_GE(rounded_up * cost(), before);
      before = cost();
    }
    expect_quiet({"resume", moved.string(), "--quiet", "--threads", "1"});
    EXPECT_GE(rounded_up * cost(), before);
  }
};

TEST_P(SceneKeys, GoThroughSaveCheckStopResumeReport) {
  const LoadedScene given = load_scene(place / sources / "case.toml");
  expect_quiet(
      {"run", (sources / "case.toml").string(), "-o", whole.string(), "--quiet", "--threads", "1"});
  if (HasFailure()) return;
  const std::vector<std::int64_t> at = stops(given.scene);
  fs::path result = whole;
  if (!at.empty()) {
    run_in_parts(at);
    if (HasFailure()) return;
    expect_same(left_in(place / whole), left_in(place / moved));
    result = moved;
  }
  fs::remove_all(place / sources);
  expect_saved(given);
  expect_quiet({"report", result.string()});
  if (drawn().contains(GetParam().name))
    expect_quiet({"figure", result.string(), "--format", "png"});
}

TEST_P(SceneKeys, StandAloneBesideASavedStudy) {
  const LoadedScene given = load_scene(place / sources / "case.toml");
  const std::string study = "scene = \"" + (sources / "case.toml").string() + "\"\n";
  std::set<fs::path> read;
  for (const InputFile& input : given.inputs) read.insert(input.source);
  fs::create_directories(place / "study");
  save_settings(place / "study/study.toml", role::study,
                whole_settings({study, place / "study.toml", schema::study_language(), read, {}}));
  fs::remove_all(place / sources);
  fs::rename(place / "study", place / moved);
  const Study saved = load_study(place / moved / "study.toml");
  ASSERT_EQ(saved.runs.size(), 1U);
  EXPECT_EQ(saved.runs.front().hash, given.hash);
}

INSTANTIATE_TEST_SUITE_P(Of, SceneKeys, ::testing::ValuesIn(all_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pulvis::keys

// Folders of studies, probes and fits stand alone: every file that a key of their languages, or of a scene's, may name lies
// beside the saved settings.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "cli/campaigns/fit/declare_fit.hpp"
#include "cli/campaigns/probe/declare_probe.hpp"
#include "cli/campaigns/study/declare_study.hpp"
#include "cli/campaigns/study/saved_settings.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/document.hpp"
#include "scenes/language/named_files.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;

// "[[stage]]\n[[stage.move]]\n" of stage.move.
std::string headers(const std::string& path, const schema::Language& language) {
  const schema::TableView* view = path.empty() ? nullptr : schema::find_table(path, language);
  if (view == nullptr) return "";
  const std::size_t dot = path.rfind('.');
  const std::string above = dot == std::string::npos ? "" : headers(path.substr(0, dot), language);
  return above + (view->info.repeated ? "[[" + path + "]]\n" : "[" + path + "]\n");
}

// A text for each key that names a file.
std::vector<std::string> texts_with_files(const schema::Language& language,
                                          const std::string& folder) {
  std::vector<std::string> texts;
  for (const schema::TableView& view : language)
    for (const schema::KeyInfo& key : view.keys) {
      const bool is_scene = key.kind == schema::Kind::scene;
      if (is_scene || key.kind == schema::Kind::file)
        texts.push_back(headers(view.info.path, language) + key.name + " = '" + folder +
                        (is_scene ? "other.toml'\n" : "data é.csv'\n"));
    }
  return texts;
}

class WholeSettingsTest : public ProgramTest {
 protected:
  void put(const fs::path& file, const std::string& text) const {
    fs::create_directories((place / file).parent_path());
    std::ofstream(place / file) << text;
  }

  // Saved, without the originals, and moved.
  fs::path saved(const std::string& text, const schema::Language& language) const {
    put("given/settings.toml", text);
    put("given/files/data é.csv", "1, 2\n");
    put("given/files/other.toml", "title = 'other'\n");
    const fs::path file = place / "given/settings.toml";
    fs::create_directories(place / "results");
    save_settings(place / "results/settings.toml", role::study,
                  whole_settings({text, file, language, {}, {}}));
    fs::remove_all(place / "given");
    fs::remove_all(place / "moved");
    fs::rename(place / "results", place / "moved");
    return place / "moved/settings.toml";
  }

  // How many files it names that lie where it says, inside the folder.
  int found(const fs::path& settings, const schema::Language& language) const {
    int count = 0;
    document::Table root = document::parse(text_of(settings));
    for_each_path(root, language, [&](schema::Kind, std::string& path) {
      const fs::path file = settings.parent_path() / path;
      EXPECT_TRUE(fs::is_regular_file(file)) << text_of(settings);
      const fs::path way = fs::weakly_canonical(file).lexically_relative(
          fs::weakly_canonical(place / "moved/inputs"));
      EXPECT_NE(*way.begin(), "..") << text_of(settings);
      ++count;
    });
    return count;
  }

  // `changes` are given the first time alone.
  void expect_same_again(const Words& command, const char* settings, const Words& results,
                         const Words& changes = {}) const {
    Words first = with(command, changes), again{command};
    first.insert(first.end(),
                 {std::string("given/studies/") + settings, "-o", "results", "--jobs", "2"});
    again.insert(again.end(), {std::string("moved/") + settings, "-o", "again", "--jobs", "2"});
    const Outcome end = pulvis(first);
    ASSERT_EQ(end.code, 0) << end.out << end.err;
    const Outcome same = pulvis(first);  // it goes on in its own folder
    ASSERT_EQ(same.code, 0) << same.out << same.err;
    EXPECT_THAT(same.out, ::testing::HasSubstr("0 to do"));
    fs::remove_all(place / "given");
    fs::rename(place / "results", place / "moved");
    const Outcome end_again = pulvis(again);
    ASSERT_EQ(end_again.code, 0) << end_again.out << end_again.err;
    for (const std::string& file : results)
      EXPECT_EQ(text_of(place / "again" / file), text_of(place / "moved" / file)) << file;
  }
};

TEST_F(WholeSettingsTest, HaveEveryFileOfTheirKeys) {
  for (const schema::Language* language :
       {&schema::study_language(), &schema::probe_language(), &schema::fit_language()}) {
    const std::vector<std::string> texts = texts_with_files(*language, "files/");
    EXPECT_FALSE(texts.empty());
    for (const std::string& text : texts)
      EXPECT_EQ(found(saved(text, *language), *language), 1) << text;
  }
}

TEST_F(WholeSettingsTest, HaveEveryFileOfTheirScenes) {
  const std::vector<std::string> near = texts_with_files(schema::scene_language(), "../files/");
  const std::vector<std::string> far =
      texts_with_files(schema::scene_language(), (place / "given/files/").string());
  EXPECT_GT(near.size(), 8U);
  for (const auto* texts : {&near, &far})
    for (const std::string& text : *texts) {
      put("given/scenes/case.toml", text);
      const fs::path study = saved("scene = 'scenes/case.toml'\n", schema::study_language());
      EXPECT_EQ(found(study, schema::study_language()), 1);
      const fs::path scene = place / "moved/inputs/given/scenes/case.toml";
      EXPECT_EQ(found(scene, schema::scene_language()), 1) << text;
      if (texts == &near) {
        EXPECT_EQ(text_of(scene), text);
      }
    }
}

// What a study changes in a scene that extends another and has variables, with a table of another folder.
TEST_F(WholeSettingsTest, OfAStudyGiveTheSameResults) {
  const fs::path keys = fs::path(paths::source_dir()) / "tests/keys/scenes";
  fs::create_directories(place / "given/more");
  fs::copy(keys, place / "given/scenes", fs::copy_options::recursive);
  put("given/more/case.toml",
      "extends = '../scenes/outlines.toml'\n[let]\nmu = 0.1\n[contact]\n"
      "friction = \"mu\"\n");
  put("given/studies/study.toml", "scene = '../more/case.toml'\n[grid]\nlet.mu = [0.1, 0.2]\n");
  expect_same_again({"study"}, "study.toml", {"variations.csv"});
}

// What --set changes, behind the file's own changes: a number, and a file by its whole path.
TEST_F(WholeSettingsTest, OfAStudyHoldWhatTheCommandLineChanged) {
  const fs::path keys = fs::path(paths::source_dir()) / "tests/keys/scenes";
  fs::create_directories(place / "given/more");
  fs::copy(keys, place / "given/scenes", fs::copy_options::recursive);
  const fs::path outline = place / "given/more/other.csv";
  fs::copy(keys / "data/grain.csv", outline);
  put("given/studies/study.toml",
      "scene = '../scenes/outlines.toml'\noverrides = ['output.samples=9', # ']'\n"
      "  \"title=an \\\"]\\\"\"]\n[grid]\ncontact.friction = [0.1]\n");
  expect_same_again({"study"}, "study.toml", {"variations.csv", "friction=0.1/history.csv"},
                    {"--set", "material.steel.density=7 g/cm^3", "--set",
                     "particle.traced.file=" + outline.string()});
  const std::string text = text_of(place / "moved/study.toml");
  EXPECT_THAT(text,
              ::testing::HasSubstr("overrides = [\"output.samples=9\", \"title=an \\\"]\\\"\", "
                                   "\"material.steel.density=7 g/cm^3\", "
                                   "\"particle.traced.file=\\\"../more/other.csv\\\"\"]\n[grid]"));
}

// A block that fills its cell, in a scene that extends another.
TEST_F(WholeSettingsTest, OfAProbeGiveTheSameResults) {
  put("given/parts/steel.toml", R"(family = "compaction"
[[material]]
name = "steel"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"
hardening_modulus = "0 MPa"
[[particle]]
name = "block"
material = "steel"
outline = "rectangle"
width = "10 mm"
height = "10 mm"
[particle.mesh]
size = "2.5 mm"
)");
  put("given/dense.toml", R"(extends = "parts/steel.toml"
[contact]
stiffness = 20
friction = 1
damping = 0.1
[cell]
width = "10 mm"
height = "10 mm"
[[body]]
particle = "block"
position = ["5 mm", "5 mm"]
[[stage]]
name = "press"
kind = "compact"
duration = "0.1 ms"
[stage.cell]
strain_xx = -0.01
strain_yy = -0.01
)");
  put("given/studies/probe.toml", R"(densities = [1.006]
[[path]]
name = "isotropic"
scene = "../dense.toml"
[probe]
directions = 4
size = 0.01
duration = "0.1 ms"
release = 0.9
)");
  expect_same_again({"probe"}, "probe.toml", {"yield_points.csv", "moduli.csv"});
}

// Copies go with the names that led to them; what lies among them and is not Pulvis's stays, and so does what is read.
TEST_F(WholeSettingsTest, LeaveNoCopyThatIsNotNamed) {
  for (const char* name : {"one/first.toml", "two/second.toml", "third.toml"})
    put(fs::path("given") / name, std::string("title = '") + name + "'\n");
  fs::create_directories(place / "results");
  const auto save = [&](const std::string& scene, const fs::path& file) {
    const std::string text = "scene = '" + scene + "'\n";
    save_settings(place / "results/study.toml", role::study,
                  whole_settings({text, place / file, schema::study_language(), {}, {}}));
  };
  const auto copies = [&] {
    std::set<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(place / "results/inputs"))
      if (entry.path().filename() != ".pulvis-files")
        found.insert(entry.path().lexically_relative(place / "results/inputs").string());
    return found;
  };
  save("one/first.toml", "given/study.toml");
  EXPECT_EQ(copies(), (std::set<std::string>{"one", "one/first.toml"}));
  save("two/second.toml", "given/study.toml");
  EXPECT_EQ(copies(), (std::set<std::string>{"two", "two/second.toml"}));
  put("results/inputs/two/mine.txt", "somebody's notes");
  save("third.toml", "given/study.toml");
  EXPECT_EQ(copies(), (std::set<std::string>{"given", "given/third.toml", "two", "two/mine.txt"}));
  save("inputs/given/third.toml", "results/study.toml");
  EXPECT_EQ(copies(), (std::set<std::string>{"given", "given/third.toml", "two", "two/mine.txt"}));
}

TEST_F(WholeSettingsTest, OfAStudyFollowTheOriginalsInItsFolder) {
  put("given/other.toml", "title = 'one'\n");
  const std::string text = "scene = 'other.toml'\n";
  const auto save = [&] {
    save_settings(
        place / "results/study.toml", role::study,
        whole_settings(
            {text, place / "given/study.toml", schema::study_language(), {}, {"seed=3"}}));
  };
  fs::create_directories(place / "results");
  save();
  put("given/other.toml", "title = 'two'\n");
  save();
  const fs::path copy = place / "results/inputs/given/other.toml";
  EXPECT_EQ(text_of(copy), "title = 'two'\n");
  EXPECT_EQ(text_of(place / "results/study.toml"),
            "overrides = [\"seed=3\"]\nscene = \"inputs/given/other.toml\"\n");
  std::ofstream(copy) << "somebody's notes";
  EXPECT_THROW(save(), ForeignFile);
  EXPECT_EQ(text_of(copy), "somebody's notes");
}

}  // namespace
}  // namespace pulvis::keys

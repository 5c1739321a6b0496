// A scene that states only what differs from another file.
#include <gmock/gmock.h>

#include <sys/stat.h>

#include "scenes/read.hpp"
#include "tests/helpers/left.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* base = R"(family = "compaction"
title = "base"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "10 mm"
mesh = { boundary_edges = 12, rings = 0, core = "even" }
[[body]]
particle = "disc"
position = ["0 mm", "5 mm"]
[[body]]
particle = "disc"
position = ["0 mm", "15 mm"]
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm"]
normal = [0, 1]
[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "20 mm"]
normal = [0, -1]
[[stage]]
name = "press"
kind = "compact"
duration = "20 us"
[[stage.move]]
tool = "bottom"
displacement = ["0 mm", "0.001 mm"]
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-0.001 mm"]
ramp = 0.4
[contact]
friction = 0.1
damping = 0.2
[output]
frames = 2
samples = 4
[[expect]]
series = "energy/plastic"
below = "1 J"
)";

class Extends : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("base.toml", base);
  }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((place / file).parent_path());
    std::ofstream(place / file) << text;
  }

  LoadedScene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return load_scene_text(text, place / "scene.toml", overrides);
  }

  // Each as file:line:col: key: ..., without the folder.
  std::string wrong_with(const std::string& text,
                         const std::vector<std::string>& overrides = {}) const {
    return without(place.string() + "/", message_of([&] { load(text, overrides); }));
  }
};

TEST_F(Extends, NothingMoreIsTheOtherScene) {
  const LoadedScene whole = load(base), same = load("extends = \"base.toml\"");
  EXPECT_EQ(same.text, whole.text);
  EXPECT_EQ(same.hash, whole.hash);
}

TEST_F(Extends, KeysReplaceKeys) {
  const Scene scene =
      load("extends = \"base.toml\"\ntitle = \"other\"\n[contact]\nfriction = 0.5").scene;
  EXPECT_EQ(scene.title, "other");
  EXPECT_EQ(scene.contact.friction, 0.5);
  EXPECT_EQ(scene.contact.damping, 0.2);
}

TEST_F(Extends, ElementsAreMatchedByName) {
  const Scene scene = load(R"(extends = "base.toml"
[[tool]]
name = "top"
point = ["0 mm", "21 mm"]
[[tool]]
name = "side"
shape = "plane"
point = ["9 mm", "0 mm"]
normal = [-1, 0])")
                          .scene;
  ASSERT_EQ(scene.tools.size(), 3U);
  EXPECT_EQ(scene.tools[0].name, "bottom");
  EXPECT_EQ(scene.tools[1].point.y(), 0.021);
  EXPECT_EQ(scene.tools[1].normal.y(), -1);
  EXPECT_EQ(scene.tools[2].name, "side");
}

TEST_F(Extends, MovesAreMatchedByTool) {
  const Scene scene = load(R"(extends = "base.toml"
stage = [{ name = "press", move = [{ tool = "top", ramp = 0.3 }] }])")
                          .scene;
  ASSERT_EQ(scene.stages.at(0).moves.size(), 2U);
  EXPECT_EQ(scene.stages[0].moves[1].ramp, 0.3);
  EXPECT_EQ(scene.stages[0].moves[1].displacement.y(), -1e-6);
  EXPECT_EQ(scene.stages[0].duration, 20e-6);
}

TEST_F(Extends, ElementsWithoutNamesReplaceAll) {
  const Scene scene = load(R"(extends = "base.toml"
body = [{ particle = "disc", position = ["0 mm", "10 mm"] }])")
                          .scene;
  ASSERT_EQ(scene.bodies.size(), 1U);
  EXPECT_EQ(scene.bodies[0].position.y(), 0.01);
  EXPECT_EQ(scene.expects.size(), 1U);
}

TEST_F(Extends, PackingsWithoutAKindChangeThoseAtTheirPosition) {
  write("one.toml", std::string(base) + R"([[packing]]
kind = "square"
particle = "disc"
rows = 2
columns = 3
corner = ["20 mm", "0 mm"]
)");
  const Scene one = load("extends = \"one.toml\"\n[[packing]]\nrows = 4\n").scene;
  ASSERT_EQ(one.packings.size(), 1U);
  EXPECT_EQ(one.packings[0].cells[1], 4);
  EXPECT_EQ(one.packings[0].cells[0], 3);
  EXPECT_EQ(one.packings[0].container.corner.x(), 0.02);
  write("two.toml",
        "extends = \"one.toml\"\npacking = [{ kind = \"square\", particle = \"disc\", rows "
        "= 1, columns = 1, corner = [\"20 mm\", \"0 mm\"] }, { kind = \"square\", particle = "
        "\"disc\", rows = 1, columns = 2, corner = [\"40 mm\", \"0 mm\"] }]\n");
  const Scene two = load("extends = \"two.toml\"\n[[packing]]\n[[packing]]\ncolumns = 3\n").scene;
  ASSERT_EQ(two.packings.size(), 2U);
  EXPECT_EQ(two.packings[0].cells[0], 1);
  EXPECT_EQ(two.packings[1].cells[0], 3);
  EXPECT_THAT(wrong_with("extends = \"two.toml\"\n[[packing]]\ncolumns = 3\n"),
              HasSubstr("scene.toml:2:1: packing[0]: without `kind` it changes the element at its "
                        "position of the extended file, which has 2, but 1 is given here"));
}

TEST_F(Extends, ParticlesOfTheOtherFileComeFirst) {
  // Further down in its file than anything is here.
  const LoadedScene loaded = load(R"(extends = "base.toml"
packing = [{ kind = "square", particle = "disc", rows = 1, columns = 1, corner = ["20 mm", "0 mm"] }])");
  EXPECT_LT(loaded.text.find("[[body]]"), loaded.text.find("[[packing]]"));
  EXPECT_EQ(load_scene_text(loaded.text, "again.toml").hash, loaded.hash);
}

TEST_F(Extends, WhatIsNotWantedIsRemoved) {
  const Scene scene = load(R"(extends = "base.toml"
remove = ["tool.bottom", "stage.press.move.bottom", "stage.press.move.top.ramp", "body[0]", "expect[0]"])")
                          .scene;
  ASSERT_EQ(scene.tools.size(), 1U);
  EXPECT_EQ(scene.tools[0].name, "top");
  ASSERT_EQ(scene.stages[0].moves.size(), 1U);
  EXPECT_NE(scene.stages[0].moves[0].ramp, 0.4);
  ASSERT_EQ(scene.bodies.size(), 1U);
  EXPECT_EQ(scene.bodies[0].position.y(), 0.015);
  EXPECT_TRUE(scene.expects.empty());
}

TEST_F(Extends, RemovedAndGivenAnewIsAllOfIt) {
  const std::string text =
      "extends = \"base.toml\"\nremove = [\"particle.disc\"]\n"
      "[[particle]]\nname = \"disc\"\nmaterial = \"steel\"\n"
      "outline = \"rectangle\"\nwidth = \"8 mm\"\nheight = \"8 mm\"";
  EXPECT_TRUE(std::holds_alternative<RectangleOutline>(load(text).scene.particles.at(0).outline));
}

TEST_F(Extends, AChainIsFollowed) {
  write("middle.toml", "extends = \"base.toml\"\nremove = [\"expect\"]\n[contact]\nfriction = 0.3");
  const Scene scene = load("extends = \"middle.toml\"\n[contact]\ndamping = 0.4").scene;
  EXPECT_EQ(scene.contact.friction, 0.3);
  EXPECT_EQ(scene.contact.damping, 0.4);
  EXPECT_THAT(scene.extended, ElementsAre(place / "middle.toml", place / "base.toml"));
}

TEST_F(Extends, FilesAreNamedFromTheFolderOfTheirFile) {
  write("parts/grain/corners.csv",
        "x (mm), y (mm)\n5, 0\n4, 4\n0, 5\n-4, 4\n-5, 0\n-4, -4\n0, -5\n4, -4\n");
  write("parts/grain.toml", R"([[particle]]
name = "grain"
material = "steel"
outline = "points"
file = "grain/corners.csv"
mesh.size = "2 mm")");
  write("parts/all.toml", std::string("extends = \"grain.toml\"\n") + base);
  const LoadedScene loaded = load(R"(extends = "parts/all.toml"
body = [{ particle = "disc", position = ["0 mm", "5 mm"] }, { particle = "grain", position = ["0 mm", "15 mm"] }])");
  ASSERT_EQ(loaded.inputs.size(), 1U);
  EXPECT_EQ(loaded.inputs[0].source, place / "parts" / "grain/corners.csv");
  EXPECT_THAT(loaded.text_in_place, HasSubstr("file = \"parts/grain/corners.csv\""));
}

// A saved scene names its files in the order of the language: a run must be known again by it.
TEST_F(Extends, TheHashDoesNotDependOnTheOrderOfFiles) {
  write("corners.csv", "x (mm), y (mm)\n5, 0\n4, 4\n0, 5\n-4, 4\n-5, 0\n-4, -4\n0, -5\n4, -4\n");
  write("flow.csv", "plastic_strain, stress [MPa]\n0, 200\n0.1, 250\n");
  const LoadedScene loaded = load(R"(extends = "base.toml"
[[body]]
particle = "grain"
position = ["20 mm", "5 mm"]
[[body]]
particle = "disc"
position = ["0 mm", "5 mm"]
[[particle]]
name = "grain"
material = "soft"
outline = "points"
file = "corners.csv"
mesh.size = "2 mm"
[[material]]
name = "soft"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
hardening = { law = "table", file = "flow.csv" }
)");
  ASSERT_EQ(loaded.inputs.size(), 2U);
  write("saved/scene.toml", loaded.text);
  for (const InputFile& input : loaded.inputs) {
    fs::create_directories((place / "saved" / input.copy).parent_path());
    fs::copy_file(input.source, place / "saved" / input.copy);
  }
  EXPECT_EQ(load_scene(place / "saved" / "scene.toml").hash, loaded.hash);
}

TEST_F(Extends, OverridesChangeTheWhole) {
  const std::string text = "extends = \"base.toml\"\n[contact]\nfriction = 0.5";
  const std::vector<std::string> overrides{"contact.friction=0.7",
                                           "tool.top.point=[\"0 m\", \"25 mm\"]"};
  const Scene scene = load(text, overrides).scene;
  EXPECT_EQ(scene.contact.friction, 0.7);
  EXPECT_EQ(scene.tools[1].point.y(), 0.025);
  EXPECT_THAT(wrong_with(base, {"extends=base.toml"}),
              HasSubstr("--set extends=base.toml: extends: cannot be set here"));
}

TEST_F(Extends, ProblemsAreToldWhereTheyWereWritten) {
  write("wrong.toml", std::string(base) + "[time]\nsafety = 2\n");
  EXPECT_THAT(wrong_with("extends = \"wrong.toml\"\n[contact]\nfrictoin = 0.1\nfriction = -1"),
              ContainsRegex("^scene.toml:3:1: contact.frictoin: unknown key.*\n"
                            "scene.toml:4:12: contact.friction: -1 is out of range.*\n"
                            "wrong.toml:51:10: time.safety: 2 is out of range"));
  EXPECT_THAT(wrong_with("extends = \"base.toml\"\n[[tool]]\nname = \"lid\"\nshape = \"plane\""),
              HasSubstr("scene.toml:2:1: tool[2].normal: required key is missing"));
  EXPECT_THAT(
      wrong_with("extends = \"base.toml\"\n[[tool]]\nname = \"top\"\n[[tool]]\nname = \"top\""),
      HasSubstr("scene.toml:5:8: tool[2].name: 'top' is the name of another tool"));
}

TEST_F(Extends, WhatIsFoundAfterReadingIsToldThereToo) {
  write(
      "close.toml",
      "extends = \"base.toml\"\nbody = [{ particle = \"disc\", position = [\"0 mm\", \"4 mm\"] }]");
  write("scene.toml", "extends = \"close.toml\"\ntitle = \"a particle in the floor\"");
  const Outcome outcome = pulvis({"check", "scene.toml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("close.toml:2:9: body[0].position: particle 0"));
}

TEST_F(Extends, WhatCannotBeExtendedIsRefused) {
  const auto refused = [&](const std::string& file) {
    return wrong_with("title = \"t\"\nextends = \"" + file + "\"");
  };
  fs::create_directory(place / "folder");
  ASSERT_EQ(mkfifo((place / "pipe").c_str(), 0600), 0);
  write("broken.toml", "[contact]\nfriction = = 1");
  write("empty.toml", "# nothing\n");
  EXPECT_THAT(refused("nowhere.toml"),
              HasSubstr("scene.toml:2:11: extends: 'nowhere.toml': there is no such file"));
  EXPECT_THAT(refused("folder"), HasSubstr("scene.toml:2:11: extends: 'folder': is a folder"));
  EXPECT_THAT(refused("pipe"), HasSubstr("scene.toml:2:11: extends: 'pipe': "));
  EXPECT_THAT(refused("broken.toml"), HasSubstr("broken.toml:2:12: syntax: "));
  EXPECT_THAT(refused("empty.toml"), HasSubstr("empty.toml:1:1: scene: is empty"));
  EXPECT_THAT(wrong_with("extends = 3"), HasSubstr("scene.toml:1:11: extends: wrong type"));
}

TEST_F(Extends, CirclesAndLongChainsAreRefused) {
  write("scene.toml", "extends = \"b.toml\"");
  write("b.toml", "extends = \"c.toml\"");
  write("c.toml", "title = \"c\"\nextends = \"./b.toml\"");
  EXPECT_THAT(wrong_with("extends = \"b.toml\""),
              HasSubstr("c.toml:2:11: extends: ./b.toml extends itself through this file"));
  EXPECT_THAT(wrong_with("extends = \"scene.toml\""), HasSubstr("scene.toml:1:11: extends: "));
  for (int i = 0; i < 9; ++i)
    write("chain-" + std::to_string(i) + ".toml",
          "extends = \"chain-" + std::to_string(i + 1) + ".toml\"");
  write("chain-6.toml", base);
  EXPECT_EQ(wrong_with("extends = \"chain-0.toml\""), "");
  write("chain-6.toml", "extends = \"base.toml\"");
  EXPECT_THAT(wrong_with("extends = \"chain-0.toml\""),
              HasSubstr("chain-6.toml:1:11: extends: a chain of more than 8 files"));
}

TEST_F(Extends, TheFamilyStays) {
  EXPECT_THAT(
      wrong_with("extends = \"base.toml\"\nfamily = \"afm\""),
      HasSubstr("scene.toml:2:10: family: is \"afm\", but base.toml:1 says \"compaction\""));
  EXPECT_EQ(wrong_with("extends = \"base.toml\"\nfamily = \"compaction\""), "");
}

TEST_F(Extends, WhatIsNotThereCannotBeRemoved) {
  const auto refused = [&](const std::string& path) {
    return wrong_with("extends = \"base.toml\"\nremove = [\"expect\", \"" + path + "\"]");
  };
  EXPECT_THAT(
      refused("tol"),
      HasSubstr("scene.toml:2:21: remove: \"tol\": there is no 'tol', did you mean 'tool'?"));
  EXPECT_THAT(refused("tool.left"), HasSubstr("no element is called 'left'"));
  EXPECT_THAT(refused("body[2]"),
              HasSubstr("there is no element [2], allowed: body[0] to body[1]"));
  EXPECT_THAT(refused("title.x"), HasSubstr("the path leads into a string"));
  EXPECT_THAT(wrong_with(std::string("remove = [\"tool\"]\n") + base),
              HasSubstr("scene.toml:1:1: remove: has no effect without extends"));
}

TEST_F(Extends, CheckPrintsTheWhole) {
  write("scene.toml", "extends = \"base.toml\"\n[contact]\nfriction = 0.5");
  const Outcome outcome = pulvis({"check", "scene.toml", "--print"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("extends")));
  EXPECT_THAT(outcome.out, HasSubstr("friction = 0.5"));
  EXPECT_EQ(load(outcome.out).hash, load_scene(place / "scene.toml").hash);
}

TEST_F(Extends, ARunStandsAloneAndResumes) {
  write("scene.toml", "extends = \"base.toml\"\n[contact]\nfriction = 0.5");
  const std::uint64_t hash = load_scene(place / "scene.toml").hash;
  ASSERT_EQ(pulvis({"run", "scene.toml", "-o", "whole"}).code, 0);
  ASSERT_EQ(pulvis({"run", "scene.toml", "-o", "parts", "--stop-after", "3"}).code, 130);
  fs::remove(place / "scene.toml");
  fs::remove(place / "base.toml");
  const Outcome resumed = pulvis({"resume", "parts"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(left_in(place / "parts").state_hash, left_in(place / "whole").state_hash);
  EXPECT_EQ(load_scene(place / "parts" / "scene.toml").hash, hash);
}

TEST_F(Extends, AStudyVariesTheWhole) {
  write("scene.toml", "extends = \"base.toml\"\ntitle = \"studied\"");
  write("study.toml", "scene = \"scene.toml\"\n[grid]\nstage.press.move.top.ramp = [0.2, 0.3]");
  const Outcome outcome = pulvis({"study", "study.toml", "-o", "study"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(load_scene(place / "study" / "ramp=0.3" / "scene.toml").scene.stages[0].moves[1].ramp,
            0.3);
  write("base.toml", "family = \"compaction\"\ncontac.friction = 1");
  EXPECT_THAT(pulvis({"study", "study.toml", "-o", "wrong"}).err,
              ContainsRegex("study.toml:1:9: scene: .*base.toml:2:1: contac: unknown table"));
}

TEST_F(Extends, WhatIsComparedMayExtend) {
  write("other/scene.toml", "extends = \"../base.toml\"\n[contact]\nfriction = 0.5");
  write(
      "parts/compared.toml",
      std::string("extends = \"../base.toml\"\n") +
          "expect = [{ series = \"energy/plastic\", like = \"../other/scene.toml\", within = 1 }]");
  write("scene.toml", "extends = \"parts/compared.toml\"\ntitle = \"compared\"");
  const Outcome outcome = pulvis({"run", "scene.toml", "-o", "run"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  fs::remove(place / "base.toml");
  EXPECT_EQ(pulvis({"check", "run/scene.toml"}).code, 0);
}

}  // namespace
}  // namespace pulvis

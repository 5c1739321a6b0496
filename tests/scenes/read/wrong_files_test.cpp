// Wrong scenes that are more than one wrong value: files, broken text, several problems, overrides.
#include "tests/helpers/right_scene.hpp"

#include <gmock/gmock.h>

#include <filesystem>

namespace pulvis {
namespace {

using testing::HasSubstr;

TEST(WrongScenes, TheSceneTheyChangeIsRight) {
  EXPECT_NO_THROW(load_scene_text(right_scene, "right.toml"));
}

TEST(WrongScenes, EveryTruncationIsRefusedOrReadWithoutHarm) {
  const std::string whole = right_scene;
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      load_scene_text(whole.substr(0, length), "cut.toml");
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("cut.toml:"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 900);  // all but those that only lose the last, optional tables
}

TEST(WrongScenes, NulByteIsRefused) {
  const auto problems = problems_of(std::string("title = \"a\0b\"", 13));
  EXPECT_EQ(problems.at(0).column, 11);
  EXPECT_THAT(problems.at(0).message, HasSubstr("NUL"));
}

TEST(WrongScenes, DeepNestingIsRefusedBeforeTheParserRecurses) {
  const std::string deep(100000, '[');
  EXPECT_THAT(problems_of("a = " + deep).at(0).message, HasSubstr("nested too deeply"));
  std::string dotted = "a";
  for (int i = 0; i < 100000; ++i) dotted += ".a";
  EXPECT_THAT(problems_of(dotted + " = 1").at(0).message, HasSubstr("allowed: 16 levels"));
}

TEST(WrongScenes, EmptySceneIsRefused) {
  EXPECT_THAT(problems_of("").at(0).text(), HasSubstr("wrong.toml:1:1: scene: is empty"));
  EXPECT_THAT(problems_of("# only a comment\n").at(0).message, HasSubstr("is empty"));
}

TEST(WrongScenes, NothingDeclaredIsRefusedForEveryPart) {
  const auto problems = problems_of("family = \"compaction\"");
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_THAT(problems[0].message, HasSubstr("at least one [[material]]"));
  EXPECT_THAT(problems[2].message, HasSubstr("[[body]] or [[packing]]"));
}

// [material.hardening] without its [[material]]: what names materials elsewhere is not to blame.
TEST(WrongScenes, ATableThatIsNoListIsToldOnceAndNotByEveryReferenceToIt) {
  std::string text = right_scene;
  const std::size_t begin = text.find("[[material]]"), end = text.find("[[particle]]");
  text.replace(begin, end - begin, "[material.hardening]\nlaw = \"linear\"\nmodulus = \"1 GPa\"\n");
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1U) << problems.back().text();
  EXPECT_THAT(problems[0].message, HasSubstr("a table is given, allowed: [[material]]"));
}

TEST(WrongScenes, IndependentProblemsAreAllReportedInTheOrderOfTheFile) {
  const auto problems = problems_of("title = 5\nfamily = \"shear\"\n[time]\nsafety = 2\n");
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].key, "title");
  EXPECT_EQ(problems[1].key, "family");
  EXPECT_EQ(problems[2].key, "time.safety");
}

TEST(WrongScenes, FilesThatAreNoScenes) {
  const std::filesystem::path folder = testing::TempDir();
  const auto refused = [](const std::filesystem::path& file) {
    return message_of([&] { read_scene(file); });
  };
  EXPECT_THAT(refused(folder / "missing.toml"), HasSubstr("there is no such file"));
  EXPECT_THAT(refused(folder), HasSubstr("is a folder"));
  EXPECT_THAT(refused("/dev/zero"), HasSubstr("is a device"));
}

TEST(WrongScenes, AnOverrideIsNamedInsteadOfAPlace) {
  const auto problem = problems_of(right_scene, {"time.safety=5"}).at(0);
  EXPECT_EQ(problem.line, 0);
  EXPECT_EQ(problem.override_text, "time.safety=5");
  EXPECT_THAT(problem.text(), HasSubstr("--set time.safety=5: time.safety: 5 is out of range"));
}

TEST(WrongScenes, OverridesThatLeadNowhere) {
  const auto refusal = [](const std::string& override) {
    return problems_of(right_scene, {override}).at(0).message;
  };
  EXPECT_THAT(refusal("title"), HasSubstr("there is no '='"));
  EXPECT_THAT(refusal("=1"), HasSubstr("an empty name"));
  EXPECT_THAT(refusal("tim.safety=0.5"), HasSubstr("did you mean 'time'?"));
  EXPECT_THAT(refusal("time.safty=0.5"), HasSubstr("did you mean 'safety'?"));
  EXPECT_THAT(refusal("tool.topp.shape=plane"), HasSubstr("did you mean 'top'?"));
  EXPECT_THAT(refusal("tool[2].shape=plane"), HasSubstr("allowed: tool[0] to tool[1]"));
  EXPECT_THAT(refusal("tool[x].shape=plane"), HasSubstr("'[x]' is not a position"));
  EXPECT_THAT(refusal("body.block.angle=1 rad"),
              HasSubstr("allowed: body[0]; these elements have no names"));
  EXPECT_THAT(refusal("material=steel"), HasSubstr("ends at a table"));
  EXPECT_THAT(refusal("title.x.y=1"), HasSubstr("leads into a string"));
  EXPECT_THAT(refusal("title.x=1"), HasSubstr("ends at a string"));
  EXPECT_THAT(refusal("time={safety=0.5}"), HasSubstr("one key at a time"));
  EXPECT_THAT(refusal("a.b.c.d.e.f.g.h.i.j=1"), HasSubstr("too deep"));
}

}  // namespace
}  // namespace pulvis

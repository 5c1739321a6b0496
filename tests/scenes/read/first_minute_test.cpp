// Mistakes of somebody's first scene: each is answered with what was meant, and with nothing that only follows from it.
#include <gmock/gmock.h>

#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/right_space_scene.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Mistake {
  const char* name;
  const char* from;  // a part of the right scene
  const char* to;
  const char* answer;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class FirstMinute : public testing::TestWithParam<Mistake> {};

std::string answers_to(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error(from);
  text.replace(at, from.size(), to);
  return message_of([&] { load_scene_text(text, "mine.toml"); });
}

TEST_P(FirstMinute, IsAnsweredWithWhatWasMeant) {
  const Mistake& mistake = GetParam();
  EXPECT_THAT(answers_to(right_scene, mistake.from, mistake.to), HasSubstr(mistake.answer));
}

INSTANTIATE_TEST_SUITE_P(
    All, FirstMinute,
    testing::Values(
        Mistake{"TopLevelKeyBelowAHeader", "rows = 2", "rows = 2\nseed = 3",
                "packing[0].seed: unknown key: 'seed' belongs to the top level, where every key is "
                "written before the first [...] or [[...]]"},
        Mistake{"TopLevelTableBelowAHeader", "rows = 2", "rows = 2\ncontact.friction = 0.1",
                "packing[0].contact: unknown table: 'contact' belongs to the top level, as "
                "[contact] or before the first [...] or [[...]]"},
        Mistake{"NestedHeader", "[[friction]]", "[[particle.friction]]",
                "unknown table: 'friction' belongs to the top level, as [[friction]]"},
        Mistake{"FrictionInAStage", "duration = \"1 ms\"", "duration = \"1 ms\"\nfriction = 0.2",
                "stage[0].friction: unknown key: 'friction' belongs into [contact]"},
        Mistake{"DisplacementInAStage", "duration = \"1 ms\"",
                "duration = \"1 ms\"\ndisplacement = [\"0 mm\", \"-1 mm\"]",
                "'displacement' belongs into [[stage.move]] or [stage.until]"},
        Mistake{"Symbol", "youngs_modulus", "E",
                "material[0].E: unknown key, did you mean 'youngs_modulus'?"},
        Mistake{"GreekSymbol", "poissons_ratio", "nu", "did you mean 'poissons_ratio'?"},
        Mistake{"Circle", "outline = \"disc\"", "outline = \"circle\"",
                "particle[0].outline: \"circle\" is unknown, did you mean 'disc'?"},
        Mistake{"Compress", "\"compact\"", "\"compress\"", "did you mean 'compact'?"},
        Mistake{"NoQuotes", "family = \"compaction\"", "family = compaction",
                "syntax: text without quotes, allowed: \"compaction\""},
        Mistake{"QuantityWithoutQuotes", "thickness = \"1 mm\"", "thickness = 1 mm",
                "text without quotes, allowed: \"1 mm\""},
        Mistake{"Colon", "title = \"right\"", "title: \"right\"",
                "a key and its value are joined by '=', allowed: key = value"},
        Mistake{"TypographicQuotes", "\"1 mm\"", "\u201C1 mm\u201D",
                "a typographic quote, \u201C, allowed: the straight quotes \" and '"},
        Mistake{"LibraryInWords", "density = \"7990 kg/m^3\"", "library = \"copper\"",
                "did you mean 'Cu-OFHC' (oxygen-free copper, annealed)?"},
        Mistake{"LibraryOfAnotherSpelling", "density = \"7990 kg/m^3\"", "library = \"Aluminum\"",
                "did you mean 'Al' (aluminium 1080, annealed)?"},
        Mistake{"MaterialThatIsNotDeclared", "material = \"316L\"", "material = \"copper\"",
                "no material is called \"copper\", allowed: 316L; to take it from the library: "
                "[[material]] name = \"copper\", library = \"Cu-OFHC\""}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(FirstMinutes, AMaterialThatIsOnlyNamedIsPointedToTheLibrary) {
  std::string text = right_scene;
  const auto begin = text.find("density"), end = text.find("[[particle]]");
  const auto problems = problems_of(text.replace(begin, end - begin, "\n"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].text(), HasSubstr("material[0]: it has a name and no properties, "
                                            "allowed: library = \"316L\""));
}

TEST(FirstMinutes, AFrictionOfAllContactsIsPointedToItsTable) {
  std::string text = right_scene;
  const auto begin = text.find("[[friction]]"), end = text.find("[time]");
  text.erase(begin, end - begin);
  EXPECT_THAT(answers_to(text, "title", "friction = 0.2\ntitle"),
              HasSubstr("a number is given, allowed: [[friction]], once for each; as one value it "
                        "belongs into [contact]"));
}

TEST(FirstMinutes, AMisspeltOutlineIsNotFollowedByItsKeys) {
  EXPECT_THAT(answers_to(right_scene, "\"disc\"", "\"circle\""), Not(HasSubstr("has no effect")));
}

TEST(FirstMinutes, AWrongDimensionIsAllThatIsTold) {
  for (const char* wrong : {"\"3D\"", "\"3\"", "3.0", "4", "true"}) {
    std::string text = right_space_scene;
    const std::string given = "dimension = 3";
    text.replace(text.find(given), given.size(), std::string("dimension = ") + wrong);
    const auto problems = problems_of(text);
    ASSERT_EQ(problems.size(), 1U) << wrong;
    EXPECT_EQ(problems[0].key, "dimension");
    EXPECT_THAT(problems[0].message, HasSubstr("allowed: 2 or 3, without quotes"));
  }
}

TEST(FirstMinutes, PositionsInOverridesAreExplained) {
  const auto refusal = [](const char* change) {
    return problems_of(right_scene, {change}).at(0).message;
  };
  EXPECT_THAT(refusal("packing.0.rows=3"),
              HasSubstr("no element is called '0': a position is written in brackets, allowed: "
                        "packing[0]; these elements have no names"));
  EXPECT_THAT(refusal("particle.0.diameter=3 mm"),
              HasSubstr("allowed: particle[0] to particle[1], or grain, block"));
  EXPECT_THAT(refusal("packing.rows=3"),
              HasSubstr("'packing' is a list, allowed: a key of one of its elements, packing[0]"));
  EXPECT_THAT(refusal("stage.press.move.0.ramp=0.2"), HasSubstr("allowed: move[0], or top"));
}

// Whatever is wrong with them: a message is read by people.
TEST(FirstMinutes, LongValuesAreShortened) {
  const std::string word(100'000, 'a'), numbers = "1" + std::string(100'000, '0');
  const auto length = [&](const std::string& from, const std::string& to) {
    return answers_to(right_scene, from, to).size();
  };
  const std::size_t most = 1200;
  EXPECT_LT(length("\"disc\"", "\"" + word + "\""), most);
  EXPECT_LT(length("\"316L\"\ndensity", "\"" + word + "\"\ndensity"), most);
  EXPECT_LT(length("\"1 mm\"", "\"" + word + "\""), most);
  EXPECT_LT(length("\"1 mm\"", "\"1 " + word + "\""), most);
  EXPECT_LT(length("\"1 mm\"", "\"" + numbers + " mm\""), most);
  EXPECT_LT(length("rows = 2", "rows = \"" + word + "\""), most);
  EXPECT_LT(length("rows = 2", "rows = [" + word + "]"), most);
  EXPECT_LT(length("rows = 2", "rows = 2\n" + word + " = 3"), most);
  EXPECT_LT(length("rows = 2", "rows = " + numbers), most);
  EXPECT_LT(length("rows = 2", "rows = 2\nspacing = \"2*" + word + "\""), most);
  EXPECT_LT(length("[0, 1]", "[0, \"" + word + "\"]"), most);
  EXPECT_LT(length("tool = \"top\"", "tool = \"" + word + "\""), most);
  EXPECT_LT(length("[\"316L\", \"bottom\"]", "[\"316L\", \"" + word + "\"]"), most);
  EXPECT_LT(length("title = \"right\"", "extends = \"" + word + "\""), most);
  EXPECT_LT(length("title", "[" + word + "]\ntitle"), most);
  EXPECT_LT(problems_of(right_scene, {"contact.friction=" + word}).at(0).text().size(), most);
  EXPECT_LT(problems_of(right_scene, {word + "=1"}).at(0).text().size(), most);
  EXPECT_LT(problems_of(right_scene, {"tool." + word + ".normal=1"}).at(0).text().size(), most);
}

}  // namespace
}  // namespace pulvis

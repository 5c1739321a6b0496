// Every kind of wrong scene is refused at its place, with the key, the reason and what is allowed.
// A case changes one thing of a right scene; '@' in the change marks where the refusal must point.
#include "right_scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace pulvis {
namespace {

using testing::HasSubstr;

struct Wrong {
  const char* name;
  const char* from;  // a part of the right scene
  const char* to;    // what it becomes, with '@' before the place that is refused
  const char* key;
  std::vector<const char*> says;
};

void PrintTo(const Wrong& wrong, std::ostream* stream) { *stream << wrong.name; }

std::string changed(const Wrong& wrong) {
  std::string text = right_scene;
  const auto at = text.find(wrong.from);
  if (at == std::string::npos) throw std::logic_error(wrong.from);
  return text.replace(at, std::string(wrong.from).size(), wrong.to);
}

SourceMark take_mark(std::string& text) {
  const auto at = text.find('@');
  if (at == std::string::npos) throw std::logic_error("no mark");
  text.erase(at, 1);
  SourceMark mark{1, 1};
  for (std::size_t i = 0; i < at; ++i)
    mark = text[i] == '\n' ? SourceMark{mark.line + 1, 1} : SourceMark{mark.line, mark.column + 1};
  return mark;
}

class WrongScene : public testing::TestWithParam<Wrong> {};

TEST_P(WrongScene, IsRefusedAtItsPlace) {
  const Wrong& wrong = GetParam();
  std::string text = changed(wrong);
  const SourceMark mark = take_mark(text);
  const std::vector<SceneProblem> problems = problems_of(text);
  ASSERT_FALSE(problems.empty());
  const auto same = [&](const SceneProblem& problem) { return problem.key == wrong.key; };
  const auto found = std::find_if(problems.begin(), problems.end(), same);
  ASSERT_NE(found, problems.end()) << problems.front().text();
  EXPECT_EQ(found->line, mark.line) << found->text();
  EXPECT_EQ(found->column, mark.column) << found->text();
  for (const char* part : wrong.says) EXPECT_THAT(found->message, HasSubstr(part));
}

const Wrong cases[] = {
    // words
    {"MisspeltKey",
     "yield_stress",
     "@yield_stres",
     "material[0].yield_stres",
     {"unknown key", "did you mean 'yield_stress'?", "allowed: name, density"}},
    {"MisspeltTopLevelKey", "thickness", "@thicknes", "thicknes", {"did you mean 'thickness'?"}},
    {"UnknownTable", "[time]", "[@tiem]", "tiem", {"unknown table", "did you mean 'time'?"}},
    {"UnknownSubTable",
     "[particle.mesh]",
     "[particle.@mseh]",
     "particle[0].mseh",
     {"unknown table", "did you mean 'mesh'?"}},
    {"UnknownFamily",
     "\"compaction\"",
     "@\"compactoin\"",
     "family",
     {"did you mean 'compaction'?", "allowed: \"compaction\""}},
    {"UnknownOutline",
     "\"disc\"",
     "@\"disk\"",
     "particle[0].outline",
     {"did you mean 'disc'?", "allowed: \"disc\", \"rectangle\""}},
    {"UnknownStageKind",
     "\"compact\"",
     "@\"press\"",
     "stage[0].kind",
     {"is unknown", "\"settle\", \"compact\", \"hold\", \"unload\""}},
    {"UnknownShape", "\"plane\"", "@\"groove\"", "tool[0].shape", {"allowed: \"plane\""}},
    // types
    {"NumberForText",
     "title = \"right\"",
     "title = @5",
     "title",
     {"wrong type, an integer is given", "allowed: a string"}},
    {"TextForNumber",
     "safety = 0.5",
     "safety = @\"0.5\"",
     "time.safety",
     {"wrong type, a string is given", "allowed: a number, > 0 and < 1"}},
    {"BooleanForQuantity",
     "\"1 ms\"",
     "@true",
     "stage[0].duration",
     {"wrong type, a boolean is given", "allowed: a quantity in s"}},
    {"DateForNumber",
     "safety = 0.5",
     "safety = @2024-05-06",
     "time.safety",
     {"wrong type, a date or time is given"}},
    {"FractionForInteger",
     "rings = 1",
     "rings = @1.5",
     "particle[0].mesh.rings",
     {"wrong type", "allowed: a whole number, >= 1"}},
    {"TextForVector",
     "[\"10 mm\", \"25 mm\"]",
     "@\"10 mm\"",
     "body[0].position",
     {"wrong type", "allowed: two quantities [x, y] in m"}},
    {"VectorOfThree",
     "[\"10 mm\", \"25 mm\"]",
     "@[\"10 mm\", \"25 mm\", \"0 mm\"]",
     "body[0].position",
     {"length 3", "two quantities"}},
    {"BareNumberInVector",
     "[\"10 mm\", \"25 mm\"]",
     "[\"10 mm\", @25]",
     "body[0].position",
     {"missing unit: write \"25 m\""}},
    {"TableForArrayOfTables",
     "[[friction]]",
     "[@friction]",
     "friction",
     {"wrong type, a table is given", "allowed: [[friction]]"}},
    {"ArrayOfTablesForTable",
     "[time]",
     "@[[time]]",
     "time",
     {"wrong type, an array of tables is given", "allowed: one table, [time]"}},
    {"ValueForTable",
     "[time]\nsafety = 0.5",
     "[contact]\nfriction = 0.1\n@[time.safety]\n",
     "time.safety",
     {"wrong type, a table is given"}},
    // units and numbers
    {"MissingUnit",
     "\"240 MPa\"",
     "@240",
     "material[0].yield_stress",
     {"missing unit: write \"240 Pa\"", "allowed: a quantity in Pa"}},
    {"MissingUnitInText",
     "\"240 MPa\"",
     "@\"240\"",
     "material[0].yield_stress",
     {"missing unit", "Pa is wanted"}},
    {"WrongDimension",
     "\"7990 kg/m^3\"",
     "@\"7990 kg\"",
     "material[0].density",
     {"\"7990 kg\" has the dimension of kg", "kg/m^3 is wanted"}},
    {"UnknownUnit",
     "\"200 GPa\"",
     "@\"200 GPasca\"",
     "material[0].youngs_modulus",
     {"unknown unit 'GPasca'", "allowed: a quantity in Pa"}},
    {"HertzForSpin",
     "position = [\"10 mm\", \"25 mm\"]",
     "position = [\"10 mm\", \"25 mm\"]\nangular_velocity = @\"10 Hz\"",
     "body[0].angular_velocity",
     {"rad/s is wanted"}},
    {"NoNumber", "\"1 ms\"", "@\"ms\"", "stage[0].duration", {"does not start with a number"}},
    {"NotANumber", "\"1 ms\"", "@\"nan ms\"", "stage[0].duration", {"not a finite number"}},
    {"Infinity", "safety = 0.5", "safety = @inf", "time.safety", {"inf is not finite"}},
    {"Overflow",
     "\"1 ms\"",
     "@\"1e999 ms\"",
     "stage[0].duration",
     {"outside what a double can hold"}},
    // ranges
    {"PoissonTooLarge",
     "0.3\n",
     "@0.5\n",
     "material[0].poissons_ratio",
     {"0.5 is out of range", "> -1 and < 0.5"}},
    {"NegativeDensity",
     "\"7990 kg/m^3\"",
     "@\"-7990 kg/m^3\"",
     "material[0].density",
     {"out of range", ">= 0.001"}},
    {"DiscTooSmall",
     "\"10 mm\"",
     "@\"0 mm\"",
     "particle[0].diameter",
     {"= 0 m is out of range", ">= 1e-12 and <= 1000"}},
    {"DiscTooLarge",
     "\"10 mm\"",
     "@\"10 km\"",
     "particle[0].diameter",
     {"= 10000 m is out of range"}},
    {"EdgesNoMultipleOfFour",
     "= 40",
     "= @42",
     "particle[0].mesh.boundary_edges",
     {"42 is no multiple of 4", "a multiple of 4"}},
    {"TooManyEdges", "= 40", "= @5000", "particle[0].mesh.boundary_edges", {"<= 4096"}},
    {"RampTooLong",
     "\"-1 mm\"]",
     "\"-1 mm\"]\nramp = @0.6",
     "stage[0].move[0].ramp",
     {"> 0 and <= 0.5"}},
    {"RampOfNothing",
     "\"-1 mm\"]",
     "\"-1 mm\"]\nramp = @0",
     "stage[0].move[0].ramp",
     {"0 is out of range"}},
    {"NegativeFriction",
     "coefficient = 0.3",
     "coefficient = @-0.3",
     "friction[0].coefficient",
     {">= 0 and <= 10"}},
    {"SafetyOfOne", "safety = 0.5", "safety = @1", "time.safety", {"> 0 and < 1"}},
    {"ZeroNormal",
     "normal = [0, 1]",
     "normal = @[0, 0]",
     "tool[0].normal",
     {"a direction of length 0", "not both 0"}},
    {"NegativeSeed", "title", "seed = @-1\ntitle", "seed", {">= 0"}},
    // presence and names
    {"MissingKey",
     "[[material]]\nname = \"316L\"\ndensity = \"7990 kg/m^3\"",
     "@[[material]]\nname = \"316L\"",
     "material[0].density",
     {"required key is missing", "allowed: a quantity in kg/m^3"}},
    {"MissingFamily",
     "family = \"compaction\"",
     "@",
     "family",
     {"required key is missing", "\"compaction\""}},
    {"MissingSize",
     "[[particle]]\nname = \"grain\"\nmaterial = \"316L\"\noutline = \"disc\"\n"
     "diameter = \"10 mm\"",
     "@[[particle]]\nname = \"grain\"\nmaterial = \"316L\"\noutline = \"disc\"",
     "particle[0].diameter",
     {"required key is missing"}},
    {"DuplicateName",
     "\"block\"",
     "@\"grain\"",
     "particle[1].name",
     {"the name of another particle", "each name once"}},
    {"ToolNamedAsMaterial", "\"top\"", "@\"316L\"", "tool[1].name", {"the name of a material"}},
    {"NameWithSlash", "\"press\"", "@\"a/b\"", "stage[0].name", {"is no name", "letters, digits"}},
    {"EmptyName", "\"press\"", "@\"\"", "stage[0].name", {"is no name", "1 to 64"}},
    {"UnknownMaterial",
     "material = \"316L\"",
     "material = @\"316l\"",
     "particle[0].material",
     {"no material is called \"316l\"", "did you mean '316L'?", "allowed: 316L"}},
    {"UnknownParticle",
     "particle = \"block\"",
     "particle = @\"blocks\"",
     "body[0].particle",
     {"did you mean 'block'?", "allowed: grain, block"}},
    {"UnknownTool",
     "tool = \"top\"",
     "tool = @\"topp\"",
     "stage[0].move[0].tool",
     {"did you mean 'top'?", "allowed: bottom, top"}},
    {"UnknownPair",
     "[\"316L\", \"bottom\"]",
     "[\"316L\", @\"botom\"]",
     "friction[0].between",
     {"no material or tool", "did you mean 'bottom'?"}},
    // keys without an effect
    {"WidthOfADisc",
     "diameter = \"10 mm\"",
     "diameter = \"10 mm\"\n@width = \"1 mm\"",
     "particle[0].width",
     {"has no effect with outline = \"disc\"", "only with \"rectangle\""}},
    {"ColumnsOfADisc",
     "rings = 1",
     "rings = 1\n@columns = 3",
     "particle[0].mesh.columns",
     {"has no effect with outline = \"disc\""}},
    {"PhaseOfARectangle",
     "height = \"10 mm\"",
     "height = \"10 mm\"\n[particle.mesh]\n@phase = \"random\"",
     "particle[1].mesh.phase",
     {"has no effect with outline = \"rectangle\"", "only with \"disc\""}},
    {"HardeningWithoutYield",
     "yield_stress = \"240 MPa\"\nh",
     "@h",
     "material[0].hardening_modulus",
     {"has no effect without yield_stress"}},
    {"UnusedMaterial",
     "[[particle]]",
     "@[[material]]\nname = \"spare\"\ndensity = \"1 kg/m^3\"\nyoungs_modulus = \"1 GPa\"\n"
     "poissons_ratio = 0\n[[particle]]",
     "material[1]",
     {"'spare' is declared but not used"}},
    {"UnusedParticle",
     "[[particle]]",
     "@[[particle]]\nname = \"spare\"\nmaterial = \"316L\"\noutline = \"disc\"\n"
     "diameter = \"1 mm\"\n[[particle]]",
     "particle[0]",
     {"'spare' is declared but not used", "[[body]] or [[packing]]"}},
    {"MoveByNothing",
     "[\"0 mm\", \"-1 mm\"]",
     "@[\"0 mm\", \"0 mm\"]",
     "stage[0].move[0].displacement",
     {"has no effect"}},
    // several keys together
    {"YieldAboveYoung",
     "\"240 MPa\"",
     "@\"240 GPa\"",
     "material[0].yield_stress",
     {"not below Young's modulus", "allowed: < 2e+11 Pa"}},
    {"HardeningAboveYoung",
     "\"440 MPa\"",
     "@\"440 GPa\"",
     "material[0].hardening_modulus",
     {"above Young's modulus", "allowed: <= 2e+11 Pa"}},
    {"CompactWithoutMove",
     "kind = \"compact\"\nduration = \"1 ms\"\n\n[[stage.move]]\ntool = \"top\"\n"
     "displacement = [\"0 mm\", \"-1 mm\"]",
     "kind = @\"compact\"\nduration = \"1 ms\"",
     "stage[0].kind",
     {"no tool moves", "at least one [[stage.move]]"}},
    {"MoveInAHold",
     "kind = \"compact\"\nduration = \"1 ms\"\n\n",
     "kind = \"hold\"\nduration = \"1 ms\"\n\n@",
     "stage[0].move[0]",
     {"tools stand still"}},
    {"ToolMovedTwice",
     "[[friction]]",
     "[[stage.move]]\ntool = @\"top\"\ndisplacement = [\"1 mm\", \"0 mm\"]\n[[friction]]",
     "stage[0].move[1].tool",
     {"'top' is moved twice", "one move for each tool"}},
    {"PairNamedTwice",
     "[time]",
     "[[friction]]\nbetween = @[\"bottom\", \"316L\"]\ncoefficient = 0.1\n[time]",
     "friction[1].between",
     {"named twice"}},
    {"TwoToolsRub",
     "[\"316L\", \"bottom\"]",
     "@[\"top\", \"bottom\"]",
     "friction[0].between",
     {"two tools never touch"}},
    {"ContactTooSoftToKeepTheForce",
     "[time]",
     "[contact]\nstiffness = @0.1\n[time]",
     "contact.stiffness",
     {"0.1 is out of range", "allowed: a number, >= 0.3 and <= 100"}},
    {"SpacingOfRectangles",
     "[[packing]]",
     "@[[packing]]\nkind = \"square\"\nparticle = \"block\"\nrows = 1\ncolumns = 1\n[[packing]]",
     "packing[0].spacing",
     {"required key is missing", "only discs"}},
    {"TooManyParticles",
     "[[packing]]\nkind = \"square\"\nparticle = \"grain\"\nrows = 2\ncolumns = 2",
     "@[[packing]]\nkind = \"square\"\nparticle = \"grain\"\nrows = 1001\ncolumns = 1000",
     "packing[0]",
     {"1001001 particles", "at most 1000000"}},
    {"MeshTooLarge",
     "[particle.mesh]\nboundary_edges = 40\nrings = 1",
     "@[particle.mesh]\nboundary_edges = 4096\nrings = 1024",
     "particle[0].mesh",
     {"quads", "at most 1000000"}},
    // text
    {"SyntaxError", "rings = 1", "rings = @= 1", "syntax", {"allowed: TOML 1.0"}},
    {"DuplicateKey",
     "rings = 1",
     "rings = 1\nrings = @2",
     "syntax",
     {"redefine", "'rings'", "each key once"}},
    {"DuplicateTable", "[time]", "[contact]\n@[contact]\n[time]", "syntax", {"each key once"}},
    {"StringNotClosed", "\"right\"", "@\"right", "syntax", {"a string is not closed"}},
    {"NonAsciiKey", "rings", "ring@\xC3\xA9", "syntax", {"outside of ASCII", "letters, digits"}},
    {"InvalidUtf8", "right", "right@\xFF", "syntax", {"no UTF-8"}},
    {"OverlongUtf8", "right", "right@\xC0\xAF", "syntax", {"no UTF-8"}},
};

std::string name_of(const testing::TestParamInfo<Wrong>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Scenes, WrongScene, testing::ValuesIn(cases), name_of);

}  // namespace
}  // namespace pulvis

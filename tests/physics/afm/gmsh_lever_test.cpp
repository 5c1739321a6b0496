// Levers from Gmsh files: the beam that Pulvis meshes itself answers the same to the last digits, tetrahedra of
// ten nodes come to the converged stiffness, and what cannot be used is refused with its line.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "tests/helpers/lever.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;
using Place = std::array<int, 3>;  // on a grid twice as fine as the cells

// The beam of 440 x 50 x 2.2 um in cells; what stands in a cell has a group.
struct Grid {
  int along = 44, across = 4;
  std::vector<double> levels{-1.1, 1.1};  // um, of the cells' faces
  std::function<std::string(int i, int j, int k)> group = [](int, int, int) { return "lever"; };
  bool tetrahedra = false;

  double x(int i) const { return 440.0 * i / (2 * along); }
  double y(int j) const { return 50.0 * j / (2 * across) - 25; }
  double z(int k) const {
    const auto below = static_cast<std::size_t>(k / 2);
    return k % 2 == 0 ? levels[below] : 0.5 * (levels[below] + levels[below + 1]);
  }
};

// A mesh of Gmsh, version 2.2.
class Msh {
 public:
  explicit Msh(const Grid& grid) : grid_(grid) {
    const auto layers = static_cast<int>(grid.levels.size()) - 1;
    for (int i = 0; i < grid.along; ++i)
      for (int j = 0; j < grid.across; ++j)
        for (int k = 0; k < layers; ++k) {
          const std::string group = grid.group(i, j, k);
          if (!group.empty()) add_cell({2 * i, 2 * j, 2 * k}, group);
        }
  }

  // Faces of elements of `group` all of whose corners are where `there` says.
  void surface(const std::string& name, const std::string& group,
               const std::function<bool(double x, double y, double z)>& there) {
    static constexpr std::array<std::array<int, 4>, 6> quads{
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    static constexpr std::array<std::array<int, 6>, 4> triangles{
        {{0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 9, 7}, {0, 2, 3, 6, 8, 7}, {1, 2, 3, 5, 8, 9}}};
    const auto take = [&](const Element& element, const auto& corners, int type) {
      Element facet{type, name, {}};
      for (const int c : corners) facet.nodes.push_back(element.nodes[static_cast<std::size_t>(c)]);
      for (const int n : facet.nodes) {
        const Place& p = places_[static_cast<std::size_t>(n)];
        if (!there(grid_.x(p[0]), grid_.y(p[1]), grid_.z(p[2]))) return;
      }
      facets_.push_back(facet);
    };
    for (const Element& element : volumes_) {
      if (element.group != group) continue;
      if (element.type == 5)
        for (const auto& corners : quads) take(element, corners, 3);
      else
        for (const auto& corners : triangles) take(element, corners, 9);
    }
  }

  std::string text() const {
    std::map<std::string, int> tags;
    for (const auto* list : {&facets_, &volumes_})
      for (const Element& e : *list) tags.try_emplace(e.group, static_cast<int>(tags.size()) + 1);
    std::ostringstream out;
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << tags.size() << "\n";
    for (const auto& [name, tag] : tags) {
      const bool volume = std::ranges::find(volumes_, name, &Element::group) != volumes_.end();
      out << (volume ? 3 : 2) << " " << tag << " \"" << name << "\"\n";
    }
    out << "$EndPhysicalNames\n$Nodes\n" << places_.size() << "\n";
    for (std::size_t n = 0; n < places_.size(); ++n)
      out << fmt::format("{} {:.17g} {:.17g} {:.17g}\n", n + 1, grid_.x(places_[n][0]),
                         grid_.y(places_[n][1]), grid_.z(places_[n][2]));
    out << "$EndNodes\n$Elements\n" << facets_.size() + volumes_.size() << "\n";
    int number = 0;
    for (const auto* list : {&facets_, &volumes_})
      for (const Element& e : *list) {
        out << ++number << " " << e.type << " 2 " << tags[e.group] << " 1";
        for (const int n : e.nodes) out << " " << n + 1;
        out << "\n";
      }
    out << "$EndElements\n";
    return out.str();
  }

 private:
  struct Element {
    int type = 0;
    std::string group;
    std::vector<int> nodes;
  };

  int node(const Place& place) {
    const auto [at, is_new] = numbers_.try_emplace(place, static_cast<int>(places_.size()));
    if (is_new) places_.push_back(place);
    return at->second;
  }

  void add_cell(const Place& at, const std::string& group) {
    const auto corner = [&](int i, int j, int k) {
      return Place{at[0] + 2 * i, at[1] + 2 * j, at[2] + 2 * k};
    };
    if (!grid_.tetrahedra) {
      // First along y, so that the reader has to find out what is thin.
      Element e{5, group, {}};
      for (const auto& [i, j, k] : {Place{0, 0, 0},
                                    {0, 1, 0},
                                    {0, 1, 1},
                                    {0, 0, 1},
                                    {1, 0, 0},
                                    {1, 1, 0},
                                    {1, 1, 1},
                                    {1, 0, 1}})
        e.nodes.push_back(node(corner(i, j, k)));
      volumes_.push_back(e);
      return;
    }
    // Kuhn's six, along the ways from one corner to the opposite one.
    for (const Place& way :
         {Place{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
      std::vector<Place> corners{at};
      for (const int axis : way) {
        corners.push_back(corners.back());
        corners.back()[static_cast<std::size_t>(axis)] += 2;
      }
      Element e{11, group, {}};
      for (const Place& p : corners) e.nodes.push_back(node(p));
      for (const auto& [a, b] :
           {std::pair{0u, 1u}, {1u, 2u}, {0u, 2u}, {0u, 3u}, {2u, 3u}, {1u, 3u}}) {
        Place middle;
        for (std::size_t c = 0; c < 3; ++c) middle[c] = (corners[a][c] + corners[b][c]) / 2;
        e.nodes.push_back(node(middle));
      }
      volumes_.push_back(e);
    }
  }

  Grid grid_;
  std::vector<Place> places_;
  std::map<Place, int> numbers_;
  std::vector<Element> volumes_, facets_;
};

bool same(double a, double b) { return std::abs(a - b) < 1e-9; }

Msh beam_of(const Grid& grid) {
  Msh msh(grid);
  const double back = grid.levels.back(), face = -1.1;
  for (const char* group : {"lever", "coating"})
    msh.surface("clamp", group, [](double x, double, double) { return same(x, 0); });
  msh.surface("face", "lever", [=](double, double, double z) { return same(z, face); });
  for (const char* group : {"lever", "coating"})
    msh.surface("back", group, [=](double, double, double z) { return same(z, back); });
  return msh;
}

class GmshLever : public testing::Test {
 protected:
  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                fmt::format("pulvis-lever-{}.msh", static_cast<const void*>(this));
  ~GmshLever() override { std::filesystem::remove(file_); }

  // The scene of `own` with a lever from a file in place of the drawing.
  std::string scene_with(const std::string& mesh, std::string own = tipless_beam()) {
    std::ofstream(file_) << mesh;
    const auto first = own.find("shape = \"beam\""), last = own.find("[tip]");
    const std::string tip = last == std::string::npos ? "" : own.substr(last);
    return own.substr(0, first) +
           fmt::format("shape = \"mesh\"\nmaterial = \"lever\"\nfile = \"{}\"\nunit = \"1 um\"\n\n",
                       file_.string()) +
           tip;
  }
  std::string refusal(const std::string& mesh, const std::string& more = "") {
    return message_of([&] { afm_scene(scene_with(mesh) + more); });
  }
};

const std::vector<std::string> as_the_grid{"lever.elements_along=44", "lever.elements_across=4"};

TEST_F(GmshLever, ABeamOfHexahedraAnswersAsPulvisOwnBeamOfTheSameNodes) {
  const Calibration own = calibration_of(beam_with_tip, as_the_grid);
  const Calibration c = calibration_of(scene_with(beam_of({}).text(), beam_with_tip));
  EXPECT_NEAR(c.normal_stiffness / own.normal_stiffness, 1, 1e-9);
  EXPECT_NEAR(c.lateral_stiffness / own.lateral_stiffness, 1, 1e-9);
  EXPECT_NEAR(c.torsional_stiffness / own.torsional_stiffness, 1, 1e-9);
  EXPECT_NEAR(c.normal_invols / own.normal_invols, 1, 1e-9);
  EXPECT_NEAR(c.lateral_invols / own.lateral_invols, 1, 1e-9);
  EXPECT_NEAR(c.arm, own.arm, 1e-15);
  EXPECT_LT(c.imbalance, 1e-9);
  EXPECT_TRUE(c.closed_forms.empty());
}

TEST_F(GmshLever, ACoatingIsASecondVolume) {
  const Grid coated{
      44, 4, {-1.1, 1.1, 1.4}, [](int, int, int k) { return k == 0 ? "lever" : "coating"; }};
  const Calibration own = calibration_of(
      tipless_beam(),
      {as_the_grid[0], as_the_grid[1], "lever.coating=stiff", "lever.coating_thickness=0.3 um"});
  const std::string text = scene_with(beam_of(coated).text());
  const Calibration c = calibration_of(text + "coating = \"stiff\"\n");
  EXPECT_NEAR(c.normal_stiffness / own.normal_stiffness, 1, 1e-9);
  EXPECT_THAT(refusal(beam_of(coated).text()), HasSubstr("the file's volume 'coating'"));
  EXPECT_THAT(refusal(beam_of({}).text(), "coating = \"stiff\"\n"),
              HasSubstr("no volume named coating"));
}

// The converged 0.3164 N/m of docs/accuracy.md, with 44 x 4 cells of six tetrahedra in one layer, edges of 10 x
// 12.5 x 2.2 um; clamped along all of its root.
TEST_F(GmshLever, ABeamOfTetrahedraComesToTheConvergedStiffness) {
  const Calibration c =
      calibration_of(scene_with(beam_of({44, 4, {-1.1, 1.1}, Grid().group, true}).text()));
  EXPECT_NEAR(c.normal_stiffness / 0.3164, 1, 0.01);
  EXPECT_LT(c.imbalance, 1e-9);
}

// Under a tip: the lever's lower face takes it by its shape functions, whatever its elements are.
TEST_F(GmshLever, ATipOfPulvisStandsUnderTetrahedra) {
  const Calibration own = calibration_of(beam_with_tip);
  const Calibration c = calibration_of(
      scene_with(beam_of({88, 8, {-1.1, 1.1}, Grid().group, true}).text(), beam_with_tip));
  EXPECT_NEAR(c.normal_stiffness / own.normal_stiffness, 1, 0.01);
  // Its elements are as large as the foot: that gives way less than in a mesh that follows its rim.
  EXPECT_NEAR(c.lateral_stiffness / own.lateral_stiffness, 1, 0.05);
}

// A block of 10 x 10 x 12.6 um in the lever's own file, its axis 15 um from the end.
TEST_F(GmshLever, ATipMayStandInTheLeversFile) {
  const Grid grid{44, 5, {-13.7, -9.5, -5.3, -1.1, 1.1}, [](int i, int j, int k) {
                    if (k == 3) return "lever";
                    return i == 42 && j == 2 ? "tip" : "";
                  }};
  Msh msh = beam_of(grid);
  msh.surface("end", "tip", [](double, double, double z) { return same(z, -13.7); });
  const std::string own = tipless_beam() +
                          "[tip]\nshape = \"block\"\nmaterial = \"stiff\"\nheight = \"12.6 um\"\n"
                          "foot = \"10 um\"\nset_back = \"15 um\"\n";
  const std::string scene =
      scene_with(msh.text()) + "[tip]\nshape = \"mesh\"\nmaterial = \"stiff\"\n";
  const Calibration expected = calibration_of(own), c = calibration_of(scene);
  EXPECT_NEAR(c.normal_stiffness / expected.normal_stiffness, 1, 0.005);
  EXPECT_NEAR(c.lateral_stiffness / expected.lateral_stiffness, 1, 0.02);
  EXPECT_NEAR(c.arm, 13.7e-6, 1e-15);
  EXPECT_THAT(refusal(msh.text()), HasSubstr("the lever's file contains a tip"));
  EXPECT_THAT(
      refusal(msh.text(), "[tip]\nshape = \"mesh\"\nmaterial = \"stiff\"\noffset = \"1 um\"\n"),
      HasSubstr("the lever's file defines the position of its tip"));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST_F(GmshLever, WhatIsNoLeverIsRefusedWithWhatIsAllowed) {
  const Grid coarse{8, 2};
  const std::string good = beam_of(coarse).text();
  EXPECT_EQ(refusal(good), "");
  for (const char* name : {"clamp", "face", "back"})
    EXPECT_THAT(refusal(replaced(good, fmt::format("\"{}\"", name), "\"other\"")),
                HasSubstr(fmt::format("the surface '{}' is missing", name)));
  EXPECT_THAT(refusal(replaced(good, "\"lever\"", "\"leaver\"")),
              HasSubstr("the volume 'leaver' is unknown, allowed: coating, glue, lever, tip"));
  EXPECT_THAT(refusal(beam_of({8, 2, {1.1, 3.3}}).text()), HasSubstr("face"));
  EXPECT_THAT(refusal(beam_of({8, 2, {-1.1, 2.2}}).text()),
              HasSubstr("allowed: its middle in z = 0"));
  Msh far(coarse);
  far.surface("clamp", "lever", [](double x, double, double) { return same(x, 440); });
  far.surface("face", "lever", [](double, double, double z) { return same(z, -1.1); });
  far.surface("back", "lever", [](double, double, double z) { return same(z, 1.1); });
  EXPECT_THAT(refusal(far.text()), HasSubstr("allowed: the clamp at x = 0"));
  EXPECT_THAT(
      refusal(beam_of({8, 2, {-1.1, 1.1}, [](int i, int, int) { return i == 4 ? "" : "lever"; }})
                  .text()),
      HasSubstr("are not connected to the clamped ones"));
  EXPECT_THAT(refusal(good, "thickness = \"2 um\"\n"), HasSubstr("lever.thickness"));
  EXPECT_THAT(refusal(good, "[laser]\nposition = \"500 um\"\n"),
              HasSubstr("allowed: on the elements of the file's surface 'back'"));
  EXPECT_THAT(refusal(good, "[tip]\nshape = \"mesh\"\nmaterial = \"stiff\"\n"),
              HasSubstr("tip.file: required key is missing"));
  EXPECT_THAT(replaced(scene_with(good), "unit = \"1 um\"\n", ""), Not(HasSubstr("unit")));
  EXPECT_THAT(message_of([&] { afm_scene(replaced(scene_with(good), "unit = \"1 um\"\n", "")); }),
              HasSubstr("lever.unit: required key is missing"));
}

// The line is that of the element.
TEST_F(GmshLever, ABadElementIsRefusedWithItsLine) {
  const Grid coarse{8, 2, {-1.1, 1.1}, Grid().group, true};
  const std::string good = beam_of(coarse).text();
  EXPECT_EQ(refusal(good), "");
  const auto line_of = [&](const std::string& what) {
    return 1 + std::count(good.begin(), good.begin() + static_cast<long>(good.find(what)), '\n');
  };
  const auto element = good.find(" 11 2 ");
  const auto begin = good.rfind('\n', element) + 1, end = good.find('\n', element);
  const std::string line = good.substr(begin, end - begin);
  std::istringstream words(line);
  std::vector<std::string> word;
  for (std::string one; words >> one;) word.push_back(one);
  const auto with = [&](std::size_t at, const std::string& node) {
    std::vector<std::string> other = word;
    other[at] = node;
    std::string joined;
    for (const auto& one : other) joined += (joined.empty() ? "" : " ") + one;
    return replaced(good, line, joined);
  };
  const std::string where = fmt::format(".msh:{}:", line_of(line));
  EXPECT_THAT(refusal(with(5, word[6])), AllOf(HasSubstr(where), HasSubstr("is flat")));
  EXPECT_THAT(refusal(with(9, word[10])),
              AllOf(HasSubstr(where), HasSubstr("Mesh.SecondOrderLinear = 1")));
  EXPECT_THAT(refusal(replaced(good, line, line.substr(0, line.rfind(' ')))),
              AllOf(HasSubstr(where), HasSubstr("a number is missing")));
  EXPECT_THAT(refusal(replaced(good, line, word[0] + " 4 2 " + word[3] + " 1 1 2 3 4")),
              AllOf(HasSubstr(where), HasSubstr("is a tetrahedron of four nodes (type 4)")));
  EXPECT_THAT(refusal(good.substr(0, begin)), HasSubstr("the section ends too early"));
}

TEST_F(GmshLever, TetrahedraThatWouldYieldAreRefused) {
  std::string text = scene_with(beam_of({8, 2, {-1.1, 1.1}, Grid().group, true}).text());
  text = replaced(text, "name = \"lever\"\n", "name = \"lever\"\nyield_stress = \"1 GPa\"\n");
  EXPECT_THAT(message_of([&] { afm_scene(text); }), HasSubstr("are elastic only"));
}

}  // namespace
}  // namespace pulvis

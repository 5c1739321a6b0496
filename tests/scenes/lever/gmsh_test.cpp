// Tips from Gmsh files: the same block as Pulvis makes answers the same, in either version of the format, and
// what cannot be used is refused with its line.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/helpers/lever.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

// The block of beam_with_tip, 2 x 2 x 12.6 um in 4 x 4 x 25 hexahedra, its nodes numbered from 10.
struct Block {
  static constexpr int across = 4, layers = 25;
  static int node(int i, int j, int k) { return 10 + (k * (across + 1) + j) * (across + 1) + i; }
  static int nodes() { return (across + 1) * (across + 1) * (layers + 1); }
  static std::string place(int n) {
    const int i = n % (across + 1), j = n / (across + 1) % (across + 1),
              k = n / (across + 1) / (across + 1);
    return fmt::format("{:.17g} {:.17g} {:.17g}", 2.0 * i / across - 1, 2.0 * j / across - 1,
                       -12.6 * k / layers);
  }
  static std::string quad(int i, int j, int k) {
    return fmt::format("{} {} {} {}", node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                       node(i, j + 1, k));
  }
};

constexpr const char* names =
    "$PhysicalNames\n3\n2 1 \"foot\"\n2 2 \"end\"\n3 7 \"tip\"\n$EndPhysicalNames\n";

template <class Each>
void for_cells(const Each& each) {
  for (int j = 0; j < Block::across; ++j)
    for (int i = 0; i < Block::across; ++i) each(i, j);
}

std::string version_2() {
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" << names << "$Nodes\n" << Block::nodes() << "\n";
  for (int n = 0; n < Block::nodes(); ++n) out << 10 + n << " " << Block::place(n) << "\n";
  const int cells = Block::across * Block::across;
  out << "$EndNodes\n$Elements\n" << cells * (2 + Block::layers) << "\n";
  int tag = 1;
  for_cells([&](int i, int j) {
    out << tag++ << " 3 2 1 5 " << Block::quad(i, j, 0) << "\n";
    out << tag++ << " 3 2 2 6 " << Block::quad(i, j, Block::layers) << "\n";
  });
  for (int k = 0; k < Block::layers; ++k)
    for_cells([&](int i, int j) {
      out << tag++ << " 5 2 7 1 " << Block::quad(i, j, k) << " " << Block::quad(i, j, k + 1)
          << "\n";
    });
  out << "$EndElements\n";
  return out.str();
}

std::string version_4() {
  std::ostringstream out;
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
      << names << "$Entities\n0 0 2 1\n5 -1 -1 0 1 1 0 1 1 0\n6 -1 -1 -12.6 1 1 -12.6 1 2 0\n"
      << "1 -1 -1 -12.6 1 1 0 1 7 2 5 6\n$EndEntities\n$Nodes\n1 " << Block::nodes() << " 10 "
      << 9 + Block::nodes() << "\n3 1 0 " << Block::nodes() << "\n";
  for (int n = 0; n < Block::nodes(); ++n) out << 10 + n << "\n";
  for (int n = 0; n < Block::nodes(); ++n) out << Block::place(n) << "\n";
  const int cells = Block::across * Block::across;
  out << "$EndNodes\n$Elements\n3 " << cells * (2 + Block::layers) << " 1 "
      << cells * (2 + Block::layers) << "\n";
  int tag = 1;
  for (const int level : {0, int{Block::layers}}) {
    out << "2 " << (level == 0 ? 5 : 6) << " 3 " << cells << "\n";
    for_cells([&](int i, int j) { out << tag++ << " " << Block::quad(i, j, level) << "\n"; });
  }
  out << "3 1 5 " << cells * Block::layers << "\n";
  for (int k = 0; k < Block::layers; ++k)
    for_cells([&](int i, int j) {
      out << tag++ << " " << Block::quad(i, j, k) << " " << Block::quad(i, j, k + 1) << "\n";
    });
  out << "$EndElements\n";
  return out.str();
}

class GmshTip : public testing::Test {
 protected:
  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                fmt::format("pulvis-tip-{}.msh", static_cast<const void*>(this));
  ~GmshTip() override { std::filesystem::remove(file_); }

  std::string scene_with(const std::string& mesh) {
    std::ofstream(file_) << mesh;
    return tipless_beam() + fmt::format(
                                "[tip]\nshape = \"mesh\"\nmaterial = \"stiff\"\nfile = "
                                "\"{}\"\nunit = \"1 um\"\nset_back = \"1 um\"\n",
                                file_.string());
  }
  std::string refusal(const std::string& mesh) {
    return message_of([&] { afm_scene(scene_with(mesh)); });
  }
};

TEST_F(GmshTip, ABlockFromAFileIsTheBlockThatPulvisMakes) {
  // Four even elements across both feet; along it the file's are all as long.
  const Calibration own = calibration_of(beam_with_tip, {"lever.foot_edge=0.25"});
  for (const std::string& mesh : {version_2(), version_4()}) {
    const Calibration c = calibration_of(scene_with(mesh), {"lever.foot_edge=0.25"});
    EXPECT_NEAR(c.normal_stiffness / own.normal_stiffness, 1, 1e-7);
    EXPECT_NEAR(c.lateral_stiffness / own.lateral_stiffness, 1, 1e-3);
    EXPECT_NEAR(c.arm, own.arm, 1e-15);
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST_F(GmshTip, WhatCannotBeUsedIsRefusedWithItsLineAndWhatIsAllowed) {
  const std::string good = version_2();
  EXPECT_EQ(refusal(good), "");
  EXPECT_THAT(refusal(replaced(good, "2.2 0 8", "2.2 1 8")), HasSubstr("allowed: ASCII"));
  EXPECT_THAT(refusal(replaced(good, "2.2 0 8", "3.0 0 8")), HasSubstr("allowed: 2.2, 4.1"));
  EXPECT_THAT(
      refusal(replaced(good, "33 5 2 7 1 10 11 16 15 35 36 41 40", "33 4 2 7 1 10 11 16 35")),
      HasSubstr("is a tetrahedron of four nodes (type 4), allowed: hexahedra"));
  EXPECT_THAT(refusal(replaced(good, "\"end\"", "\"bottom\"")), HasSubstr("\"foot\" and \"end\""));
  EXPECT_THAT(refusal(replaced(good, "33 5 2 7 1 10 11", "33 5 2 7 1 9999 11")),
              HasSubstr("node 9999 does not exist"));
  EXPECT_THAT(refusal(replaced(good, "33 5 2 7 1 10 11 16 15", "33 5 2 7 1 10 16 11 15")),
              HasSubstr("is inverted"));
  EXPECT_THAT(refusal(good.substr(0, good.rfind('\n', good.size() / 2) + 1)),
              HasSubstr("ends too early"));
  EXPECT_THAT(refusal(replaced(good, "\n1 3 2 1 5 10 11 16 15", "\n1 3 2 1 5 10 11 16 20")),
              HasSubstr("an element of 'foot' is not a face of a volume element"));
  EXPECT_THAT(refusal(replaced(good, "\n10 -1 -1 ", "\n10 -1e9 -1 ")),
              HasSubstr("allowed: up to 1 m"));
  // A count is only what the file claims: no memory is taken for it.
  EXPECT_THAT(refusal(replaced(version_4(), fmt::format("3 1 0 {}\n", Block::nodes()),
                               "3 1 0 1000000000000000\n")),
              HasSubstr("Nodes"));
  EXPECT_THAT(refusal("no mesh"), HasSubstr("allowed: an MSH file"));
}

}  // namespace
}  // namespace pulvis

// Flow laws of materials: what their keys make, and what is refused together.
#include "scenes/spec/flow_laws.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "systems/laws/flow_law.hpp"
#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

std::string with(const std::string& flow,
                 const std::string& yield = "yield_stress = \"240 MPa\"\n") {
  std::string text = right_scene;
  const std::string from = "yield_stress = \"240 MPa\"\nhardening_modulus = \"440 MPa\"\n";
  return text.replace(text.find(from), from.size(), yield + flow);
}

class FlowLawKeys : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  Scene scene(const std::string& text) { return load_scene_text(text, folder_ / "s.toml").scene; }
  std::string refused(const std::string& text) {
    return message_of([&] { scene(text); });
  }
  Scene of_table(const std::string& csv) {
    std::ofstream(folder_ / "flow.csv") << csv;
    return scene(with(table_, ""));
  }
  std::string refused_table(const std::string& csv) {
    return message_of([&] { of_table(csv); });
  }

  const std::string table_ = "[material.hardening]\nlaw = \"table\"\nfile = \"flow.csv\"\n";
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("pulvis-flow-laws-" + std::to_string(::getpid()));
};

TEST_F(FlowLawKeys, MakeTheirLaws) {
  const Scene voce = scene(with(
      "[material.hardening]\nlaw = \"voce\"\nsaturation = \"180 MPa\"\nsaturation_rate = 12\n"));
  const auto& a = std::get<kernels::VoceHardening>(voce.materials[0].flow->hardening);
  EXPECT_EQ(a.sigma_y, 240e6);
  EXPECT_EQ(a.Q, 180e6);
  EXPECT_EQ(a.b, 12);
  const Scene swift = scene(with(
      "[material.hardening]\nlaw = \"swift\"\nreference_strain = 0.02\nexponent = 0.2\n"
      "[material.rate]\nlaw = \"cowper-symonds\"\nreference_rate = \"40 1/s\"\nexponent = 5\n"));
  const auto& b = std::get<kernels::SwiftHardening>(swift.materials[0].flow->hardening);
  EXPECT_EQ(b.sigma_y, 240e6);
  EXPECT_EQ(b.eps_0, 0.02);
  EXPECT_EQ(b.n, 0.2);
  const auto& rate = std::get<kernels::CowperSymonds>(swift.materials[0].flow->rate);
  EXPECT_EQ(rate.C, 40);
  EXPECT_EQ(rate.p, 5);
  const Scene ludwik = scene(
      with("[material.hardening]\nlaw = \"ludwik\"\nstrength = \"0.4 GPa\"\nexponent = 0.5\n"));
  const auto& c = std::get<kernels::LudwikHardening>(ludwik.materials[0].flow->hardening);
  EXPECT_EQ(c.K, 0.4e9);
  EXPECT_EQ(c.n, 0.5);
}

TEST_F(FlowLawKeys, LinearIsThePlainMaterial) {
  const Scene s = scene(with("[material.hardening]\nlaw = \"linear\"\nmodulus = \"440 MPa\"\n"));
  EXPECT_EQ(s.materials[0].flow, nullptr);
  EXPECT_EQ(s.materials[0].hardening_modulus, 440e6);
}

TEST_F(FlowLawKeys, TableStatesTheYieldStress) {
  const Scene s = of_table("plastic_strain;stress [MPa]\n0;100\n0,1;150\n");
  EXPECT_EQ(s.materials[0].yield_stress, 100e6);
  const auto& law = std::get<kernels::TabulatedHardening>(s.materials[0].flow->hardening);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.05), 125e6);
}

TEST_F(FlowLawKeys, RefuseWhatDoesNotFit) {
  const std::string voce = "[material.hardening]\nlaw = \"voce\"\nsaturation = \"1 MPa\"\n";
  EXPECT_THAT(refused(with(voce)), HasSubstr("hardening.saturation_rate: required key is missing"));
  EXPECT_THAT(refused(with(voce + "saturation_rate = 2\n", "")),
              HasSubstr("s.toml:10:1: material[0].hardening: has no effect without yield_stress"));
  EXPECT_THAT(refused(with(voce + "saturation_rate = 2\nexponent = 0.5\n")),
              HasSubstr("has no effect with law = \"voce\""));
  EXPECT_THAT(refused(with("hardening_modulus = \"1 MPa\"\n" + voce + "saturation_rate = 2\n")),
              HasSubstr("material[0].hardening_modulus: is the short form of linear hardening"));
  EXPECT_THAT(refused(with("[material.hardening]\nlaw = \"voce\"\nsaturation = \"-1 MPa\"\n"
                           "saturation_rate = 2\n")),
              HasSubstr("saturation"));
  EXPECT_THAT(refused(with(table_)), HasSubstr("material[0].yield_stress: it is given by the table of"));
  EXPECT_THAT(refused(with("[material.rate]\nlaw = \"cowper-symonds\"\nreference_rate = \"1 1/s\"\n"
                           "exponent = 0.5\n")),
              HasSubstr("exponent"));
}

TEST_F(FlowLawKeys, RefuseTablesByLineAndColumn) {
  const std::string head = "plastic_strain,stress [MPa]\n";
  EXPECT_THAT(refused_table(head + "0.1,100\n"), HasSubstr("flow.csv:2:1: plastic_strain: 0.1 in"));
  EXPECT_THAT(refused_table(head + "0,100\n0,120\n"),
              HasSubstr("flow.csv:3:1: plastic_strain: 0 is not above"));
  EXPECT_THAT(refused_table(head + "0,100\n0.1,90\n"),
              HasSubstr("flow.csv:3:5: stress: 9e+07 Pa is below"));
  EXPECT_THAT(refused_table(head), HasSubstr("flow.csv"));
  EXPECT_THAT(refused_table("plastic_strain,stress [mm]\n0,1\n"), HasSubstr("flow.csv"));
  EXPECT_THAT(refused_table(head + "0,300000\n"), HasSubstr("not below Young's modulus"));
  std::filesystem::remove(folder_ / "flow.csv");
  EXPECT_THAT(refused(with(table_, "")), HasSubstr("flow.csv"));
}

}  // namespace
}  // namespace pulvis

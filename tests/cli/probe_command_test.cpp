// pulvis probe as a user meets it: a solid whose yield surface is known is probed, what was broken off goes on, and what is
// wrong is refused.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string shared(const char* file) {
  return text_of(paths::source_dir() + "/tests/helpers/solid-probe/" + file);
}
const std::string dense = shared("dense.toml"), probes = shared("probe.toml");

class ProbeCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    std::ofstream(place / "dense.toml") << dense;
    write(probes);
  }
  void write(const std::string& text) const { std::ofstream(place / "probe.toml") << text; }
  Outcome probe(const Words& more = {}) const {
    Words words{"probe", "probe.toml", "-o", "probed", "--jobs", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return pulvis(words);
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(text_of(place / "probed/summary.json"));
  }
};

// Plane strain, no hardening: von Mises' stress is the yield stress wherever the block is sheared, whatever the pressure.
TEST_F(ProbeCommand, FindsVonMisesCylinderInASolid) {
  const Outcome outcome = probe();
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const auto state = summary().at("states").at(0);
  const double e = 200e9, nu = 0.3;
  EXPECT_NEAR(state.at("states").at(0).at("youngs_modulus").get<double>() / e, 1, 0.03);
  EXPECT_NEAR(state.at("states").at(0).at("poissons_ratio").get<double>(), nu, 0.02);
  EXPECT_NEAR(state.at("states").at(0).at("shear_modulus").get<double>() / (e / (2 * (1 + nu))), 1,
              0.05);
  const double in_springs = state.at("states").at(0).at("released_by_springs").get<double>();
  EXPECT_GT(in_springs, 0);
  EXPECT_LT(in_springs, 0.15);
  EXPECT_THAT(outcome.err, Not(HasSubstr("in contact springs")));
  int sheared = 0;  // and not about to come apart: there the stress is not the same all over
  for (const char* criterion : {"offset_strain", "dissipation"})
    for (const auto& point : state.at("yield").at(criterion).at("points")) {
      if (point.at("set") != "axial") continue;
      const double angle = point.at("angle").get<double>();
      const double shear = std::abs(std::cos(angle) - std::sin(angle));
      if (shear < 0.5 || point.at("plane_p").get<double>() < 500e6) continue;
      EXPECT_NEAR(std::abs(point.at("q").get<double>()) / 240e6, 1, 0.005) << criterion << angle;
      ++sheared;
    }
  EXPECT_GE(sheared, 4);
  for (const char* file :
       {"probe.toml", "yield_points.csv", "moduli.csv", "caps.csv", "report.html"})
    EXPECT_TRUE(fs::exists(place / "probed" / file)) << file;

  // The report links to the runs that the results come from.
  const auto has_report = [&](const nlohmann::json& from) {
    return fs::exists(place / "probed" / from.at("run").get<std::string>() / "report.html");
  };
  EXPECT_TRUE(has_report(state.at("states").at(0)));
  for (const char* criterion : {"offset_strain", "dissipation"})
    for (const auto& point : state.at("yield").at(criterion).at("points"))
      EXPECT_TRUE(has_report(point)) << point.at("run");

  // What is finished is kept, and says the same.
  const std::string before = text_of(place / "probed/yield_points.csv");
  fs::remove_all(place / "probed/isotropic,density=1.006,direction=90");
  const Outcome again = probe();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("9 runs: 1 to do, 8 finished before"));
  EXPECT_EQ(text_of(place / "probed/yield_points.csv"), before);

  const Outcome figure = pulvis({"figure", "probed"});
  EXPECT_EQ(figure.code, 0) << figure.err;
  EXPECT_TRUE(fs::exists(place / "probed/pictures/yield_surfaces.png"));
}

// A cube in a cubic cell: the axes can be exchanged, and so can the directions of its probes.
TEST_F(ProbeCommand, FindsTheSymmetryOfACube) {
  std::ofstream(place / "dense-space.toml") << shared("dense-space.toml");
  write(shared("probe-space.toml") + "[[direction]]\nname = \"along_x\"\nxx = -1\n");
  const Outcome outcome = probe();
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("unloading: 1 run: 1 to do"));
  const auto group = summary().at("states").at(0), state = group.at("states").at(0);
  EXPECT_EQ(group.at("dimension"), 3);
  const auto c = [&](const char* name) { return state.at("stiffness").at(name).get<double>(); };
  const auto alike = [&](std::array<const char*, 3> names) {
    for (const char* name : names) EXPECT_NEAR(c(name) / c(names[0]), 1, 3e-3) << name;
  };
  alike({"c11", "c22", "c33"});
  alike({"c12", "c13", "c23"});
  alike({"c44", "c55", "c66"});
  for (const char* none : {"c14", "c25", "c36", "c45", "c56"})
    EXPECT_NEAR(c(none) / c("c11"), 0, 1e-3) << none;
  EXPECT_NEAR(state.at("off").at("orthotropic").get<double>(), 0, 4e-3);
  EXPECT_NEAR(state.at("engineering").at("E_x").get<double>() /
                  state.at("engineering").at("E_z").get<double>(),
              1, 2e-3);
  EXPECT_NEAR(state.at("coordination").get<double>(), 6, 1e-9);  // its own images
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(state.at("fabric").at(k).get<double>(), 1.0 / 3, 1e-3);

  std::map<std::string, nlohmann::json> points;
  for (const auto& point : group.at("yield").at("dissipation").at("points"))
    points[point.at("direction").get<std::string>()] = point;
  const auto value = [&](const char* direction, const char* name) {
    return points.at(direction).at(name).get<double>();
  };
  for (const char* name : {"p", "q"})
    for (const std::array<const char*, 3>& alike_ones :
         {std::array{"lode=0", "lode=120", "lode=240"},
          std::array{"shear_xy", "shear_yz", "shear_zx"},
          std::array{"direction=270", "along_x", "along_x"}})
      for (const char* one : alike_ones)
        EXPECT_NEAR(std::abs(value(one, name) / value(alike_ones[0], name)), 1, 5e-3)
            << one << name;
  EXPECT_NEAR(value("lode=120", "lode_angle"), 2 * std::numbers::pi / 3, 0.01);
  const auto& turned = points.at("shear_yz").at("stress");
  EXPECT_GT(std::abs(turned.at(4).get<double>()), 1e7);  // yz
  EXPECT_LT(std::abs(turned.at(3).get<double>()), 1e-2 * std::abs(turned.at(4).get<double>()));
}

TEST_F(ProbeCommand, RefusesWhatCannotBeProbed) {
  const auto refused = [&](const std::string& text, const char* says) {
    write(text);
    const Outcome outcome = probe();
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_FALSE(fs::exists(place / "probed")) << text;
  };
  const std::string& good = probes;
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string text = good;
    return text.replace(text.find(what), what.size(), instead);
  };
  refused(with("[1.006]", "[0.9, 0.8]"), "do not increase");
  refused(with("[1.006]", "[]"), "densities");
  refused(with("duration = \"0.4 ms\"\n", ""), "probe.duration");
  refused(with("directions = 8", "directions = 3"), "directions");
  refused(with("directions = 8", "direction = 8"), "did you mean");
  refused(with("dense.toml", "none.toml"), "none.toml");
  refused(good.substr(0, good.find("[[path]]")) + good.substr(good.find("[probe]")), "path");
  std::string held = dense.substr(0, dense.find("[stage.cell]"));
  held.replace(held.find("\"compact\""), 9, "\"hold\"");
  std::ofstream(place / "dense.toml") << held;
  refused(good, "does not deform a periodic cell");
}

TEST_F(ProbeCommand, TellsOfADensityThatIsNotReached) {
  write(std::string(probes).replace(probes.find("1.006"), 5, "1.2"));
  const Outcome outcome = probe();
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("relative density is"));
  EXPECT_THAT(outcome.err, HasSubstr("not reached: 1 state\n"));
}

TEST_F(ProbeCommand, ListsAndWritesNothing) {
  const Outcome outcome = probe({"--list"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1 loading run, 1 state, 9 probes"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
  EXPECT_FALSE(fs::exists(place / "probed"));
}

TEST_F(ProbeCommand, TellsOfSoftContactsBeforeItRuns) {
  const Outcome outcome = probe({"--list", "--set", "contact.stiffness=0.5"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: path 'isotropic' is probed for moduli: with "
                                     "contact.stiffness = 0.5"));
  EXPECT_THAT(outcome.err, HasSubstr("use contact.stiffness = 10 (up to a quarter more CPU time"));
}

}  // namespace
}  // namespace pulvis

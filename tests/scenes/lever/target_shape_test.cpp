// Surfaces that a probe touches, held by FCL: distance and normal against the exact surface.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>

#include "engine/files/hdf5.hpp"
#include "scenes/lever/target_shape.hpp"

namespace pulvis {
namespace {

using Place = TargetShape::Place;

TargetSpec spec_of(TargetSpec::Shape shape) {
  TargetSpec t;
  t.shape = shape;
  t.slope = 2;
  t.height = 20e-9;
  t.plateau = 30e-9;
  t.wavelength = 400e-9;
  return t;
}

std::shared_ptr<const TargetShape> target_of(const TargetSpec& t) {
  return make_target(t, Scene{}, 1e-6);
}

void expect_nearest(const TargetShape& shape, const Place& place, double distance,
                    const Place& normal) {
  const auto found = shape.nearest(place);
  EXPECT_NEAR(found.distance, distance, 1e-14) << place[1] << ' ' << place[2];
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(found.normal[k], normal[k], 1e-7) << place[1] << ' ' << place[2];
}

TEST(TargetShape, AStepHasItsPlanesAndASharpUpperEdge) {
  const auto step = target_of(spec_of(TargetSpec::Shape::step));
  expect_nearest(*step, {0, -100e-9, 5e-9}, 5e-9, {0, 0, 1});
  expect_nearest(*step, {50e-9, 200e-9, 27e-9}, 7e-9, {0, 0, 1});
  // On the flank, 3 nm out of its middle.
  const double c = 1 / std::sqrt(5.0), s = 2 * c;
  expect_nearest(*step, {0, 5e-9 - 3e-9 * s, 10e-9 + 3e-9 * c}, 3e-9, {0, -s, c});
  // Beyond the edge, between the normals of flank and plateau.
  const double a = 0.3;
  expect_nearest(*step, {0, 10e-9 - 8e-9 * std::sin(a), 20e-9 + 8e-9 * std::cos(a)}, 8e-9,
                 {0, -std::sin(a), std::cos(a)});
}

TEST(TargetShape, TheNormalTurnsByItsDerivativeAroundAnEdge) {
  const auto step = target_of(spec_of(TargetSpec::Shape::step));
  const Place at{0, 10e-9 - 8e-9 * std::sin(0.3), 20e-9 + 8e-9 * std::cos(0.3)};
  const auto middle = step->nearest(at);
  constexpr double h = 1e-12;
  for (std::size_t k = 0; k < 3; ++k) {
    Place ahead = at, behind = at;
    ahead[k] += h, behind[k] -= h;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR((step->nearest(ahead).normal[i] - step->nearest(behind).normal[i]) / (2 * h),
                  middle.turn[3 * i + k], 1e-3 / 8e-9)
          << i << k;
  }
}

// What a bump is by default.
TEST(TargetShape, ABumpWithoutAPlateauIsARidge) {
  TargetSpec t = spec_of(TargetSpec::Shape::bump);
  t.plateau = 0;
  const auto bump = target_of(t);
  expect_nearest(*bump, {0, -100e-9, 5e-9}, 5e-9, {0, 0, 1});
  const double c = 1 / std::sqrt(5.0), s = 2 * c;
  for (const double side : {-1.0, 1.0})
    expect_nearest(*bump, {0, 10e-9 + side * (5e-9 + 3e-9 * s), 10e-9 + 3e-9 * c}, 3e-9,
                   {0, side * s, c});
  expect_nearest(*bump, {0, 10e-9, 28e-9}, 8e-9, {0, 0, 1});
}

// In a valley both sides push: the normal turns from one to the other within a thousandth of the height.
TEST(TargetShape, AValleyIsRoundedByAThousandthOfItsHeight) {
  const auto step = target_of(spec_of(TargetSpec::Shape::step));
  const auto foot = step->nearest({0, 0, 0});
  EXPECT_NEAR(foot.distance, -20e-12 * std::log(2.0), 1e-14);
  const double half = 0.5 * std::atan(2.0);
  EXPECT_NEAR(foot.normal[1], -std::sin(half), 1e-6);
  EXPECT_NEAR(foot.normal[2], std::cos(half), 1e-6);
  expect_nearest(*step, {0, -3e-9, 0}, 0, {0, 0, 1});
}

TEST(TargetShape, ABumpIsTheSameFromBothSides) {
  const auto bump = target_of(spec_of(TargetSpec::Shape::bump));
  const double middle = 10e-9 + 15e-9;
  for (const double y : {3e-9, 12e-9, 17e-9, 40e-9}) {
    const auto left = bump->nearest({0, middle - y, 25e-9});
    const auto right = bump->nearest({1e-9, middle + y, 25e-9});
    EXPECT_NEAR(left.distance, right.distance, 1e-15) << y;
    EXPECT_NEAR(left.normal[1], -right.normal[1], 1e-7) << y;
  }
}

// 200 facets a wave: chords lie within h (pi/200)^2 of it.
TEST(TargetShape, ASinusoidIsItsWave) {
  const auto wave = target_of(spec_of(TargetSpec::Shape::sinusoid));
  for (const double y : {13e-9, 77e-9, 130e-9, 290e-9}) {
    const double k = 2 * std::numbers::pi / 400e-9;
    const double z = 10e-9 * std::sin(k * y), slope = 10e-9 * k * std::cos(k * y);
    const double c = 1 / std::hypot(1, slope);
    const auto found = wave->nearest({0, y - 2e-9 * slope * c, z + 2e-9 * c});
    EXPECT_NEAR(found.distance, 2e-9, 20e-9 * 2.5e-4) << y;
    EXPECT_NEAR(found.normal[1], -slope * c, 5e-3) << y;
  }
}

class HeightMap : public testing::Test {
 protected:
  HeightMap() {
    std::filesystem::create_directories(folder);
    std::ofstream text(folder / "map.csv");
    text << std::setprecision(17) << "# a plane\n";
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 7; ++i) {
        heights.push_back(1e-9 * (3 * i - 2 * j));
        text << heights.back() << (i < 6 ? "," : "\n");
      }
    hdf5::File file = hdf5::File::create(folder / "map.h5");
    file.write("/height", heights, {5, 7});
    file.close();
  }
  std::filesystem::path folder = std::filesystem::temp_directory_path() / "pulvis_height_map";
  std::vector<double> heights;
};

TEST_F(HeightMap, TextAndHdf5HoldTheSame) {
  const auto text = read_height_map(folder / "map.csv", "");
  EXPECT_EQ(text, read_height_map(folder / "map.h5", "height"));
  EXPECT_EQ(text.size(), 5u);
  EXPECT_EQ(text[4][6], 1e-9 * (18 - 8));
  EXPECT_THROW(read_height_map(folder / "map.h5", "depth"), std::runtime_error);
}

TEST_F(HeightMap, AnInclinedMapIsAPlane) {
  TargetSpec t = spec_of(TargetSpec::Shape::map);
  t.file = "map.csv";
  t.spacing = 10e-9;
  Scene scene;
  scene.file = folder / "scene.toml";
  const auto map = make_target(t, scene, 1e-6);
  const double length = std::hypot(1, 0.3, 0.2);
  const double middle = 1e-9 * (9 - 4);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {13e-9, -7e-9}, {-21e-9, 11e-9}}) {
    const double z = middle + 0.3 * x - 0.2 * y;
    expect_nearest(*map, {x - 0.3 * 4e-9 / length, y + 0.2 * 4e-9 / length, z + 4e-9 / length},
                   4e-9, {-0.3 / length, 0.2 / length, 1 / length});
  }
}

// A microscope counts heights from anywhere: what all of them have in common does not move the surface away.
TEST_F(HeightMap, WhatAllHeightsHaveInCommonIsTakenOff) {
  std::ofstream text(folder / "far.csv");
  text << std::setprecision(17);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 7; ++i)
      text << 0.1 + heights[static_cast<std::size_t>(7 * j + i)] << (i < 6 ? "," : "\n");
  text.close();
  const auto map_of = [&](const char* file) {
    TargetSpec t = spec_of(TargetSpec::Shape::map);
    t.file = file;
    t.spacing = 10e-9;
    Scene scene;
    scene.file = folder / "scene.toml";
    return make_target(t, scene, 1e-6);
  };
  // The lowest of the heights, -8 nm, is zero now.
  const auto near = map_of("map.csv"), far = map_of("far.csv");
  for (const double x : {-12e-9, 0.0, 7e-9}) {
    const auto here = near->nearest({x, 3e-9, 20e-9}), there = far->nearest({x, 3e-9, 28e-9});
    EXPECT_NEAR(here.distance, there.distance, 1e-16);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(here.normal[k], there.normal[k], 1e-7);
  }
}

TEST_F(HeightMap, TheLargestStepIsThatOfAllNeighbours) {
  const auto map = read_height_map(folder / "map.csv", "");
  EXPECT_NEAR(steepest_step(map), 3e-9, 1e-17);
  EXPECT_EQ(steepest_step({{1, 1}, {-1e308, 1}}), 1e308);
  EXPECT_TRUE(std::isinf(steepest_step({{1e308, -1e308}})));
  const auto [lowest, highest] = height_range(map);
  EXPECT_NEAR(lowest, -8e-9, 1e-23);
  EXPECT_NEAR(highest, 18e-9, 1e-23);
}

}  // namespace
}  // namespace pulvis

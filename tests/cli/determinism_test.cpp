// A run gives the same bits with any number of threads, and every time: sums have a fixed order.
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "engine/files/hdf5.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using Bits = std::map<std::string, std::vector<std::byte>>;

// The punch at 25 m/s on average: the upper rows touch, slide and flow plastically within 500 steps.
const std::vector<std::string> fast_punch{
    "stage.press.duration=50 us", "stage.press.move[0].displacement=[\"0 mm\", \"-1.25 mm\"]"};

// Every column: positions, velocities, stresses, plastic strains, and the rows with their history.
Bits bits_of(const World& world) {
  Bits bits;
  for (const ColumnBase* c : world.columns())
    bits[c->entity + "/" + c->info.name] = {c->data(), c->data() + c->bytes()};
  const Totals& t = world.resource<Totals>();
  const std::array sums{t.external_work,  t.friction_work,     t.damping_work,
                        t.contact_energy, t.worst_penetration, world.resource<Clock>().time};
  const auto bytes = std::as_bytes(std::span(sums));
  bits["totals and clock"] = {bytes.begin(), bytes.end()};
  return bits;
}

constexpr int steps = 500;

Bits state_after(int threads, const std::string& formulation = "one-point") {
  std::vector<std::string> changes = fast_punch;
  changes.push_back("element.formulation=" + formulation);
  Experiment e("compaction/regular-25.toml", changes, threads);
  e.simulation.run_steps(steps);
  e.simulation.observe();
  return bits_of(e.simulation.world());
}

void expect_same(const Bits& a, const Bits& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, bits] : a) EXPECT_TRUE(bits == b.at(name)) << name << " differs";
}

template <class C>
double largest(const Experiment& e) {
  const double* values = e.column<C>().values();
  return *std::max_element(values, values + e.column<C>().bytes() / sizeof(double));
}

// Without this the tests below would compare nothing of interest.
TEST(Determinism, TheComparedStateIsPlasticAndSlides) {
  Experiment e("compaction/regular-25.toml", fast_punch);
  e.simulation.run_steps(steps);
  EXPECT_GT(largest<PlasticStrain<OnePoint::points>>(e), 1e-3);
  EXPECT_GT(largest<ElasticSlip<Contact>>(e), 0);
  EXPECT_GT(largest<ElasticSlip<ToolContact>>(e), 0);
  EXPECT_GT(e.simulation.world().resource<Totals>().friction_work, 0);
  EXPECT_GT(e.simulation.world().resource<Totals>().touching, 50);
  EXPECT_GT(e.simulation.world().resource<ContactIndex>().bins, 1);
}

TEST(Determinism, TwoRunsAgreeInEveryBit) { expect_same(state_after(2), state_after(2)); }

TEST(Determinism, ThreadsDoNotChangeABit) {
  const Bits one = state_after(1);
  ASSERT_TRUE(one.contains("element/plastic_hourglass"));
  expect_same(one, state_after(2));
  expect_same(one, state_after(3));
}

TEST(Determinism, ThreadsDoNotChangeABitOfFourPointElements) {
  const Bits one = state_after(1, "four-point");
  ASSERT_FALSE(one.contains("element/plastic_hourglass"));
  expect_same(one, state_after(2, "four-point"));
  expect_same(one, state_after(3, "four-point"));
}

// What a sample looks at must not disturb the run.
TEST(Determinism, ObservingDoesNotChangeTheRun) {
  Experiment plain("compaction/regular-25.toml", fast_punch, 2);
  plain.simulation.run_steps(200);
  Experiment observed("compaction/regular-25.toml", fast_punch, 2);
  for (int i = 0; i < 4; ++i) {
    observed.simulation.run_steps(49);
    observed.simulation.observe();
    observed.simulation.move();
  }
  plain.simulation.observe();
  observed.simulation.observe();
  expect_same(bits_of(plain.simulation.world()), bits_of(observed.simulation.world()));
}

// ---- through the program ------------------------------------------------------------------------
class ProgramDeterminism : public ::testing::Test {
 protected:
  void SetUp() override {
    place = fs::temp_directory_path() / ("pulvis-determinism-" + std::to_string(getpid()));
    fs::remove_all(place);
    fs::create_directories(place);
  }
  void TearDown() override { fs::remove_all(place); }

  hdf5::File run(const std::string& name, int threads) const {
    std::string command = std::string("'") + paths::program() + "' run '" + paths::source_dir() +
                          "/scenes/compaction/regular-25.toml' -o '" + (place / name).string() +
                          "' --set output.frames=4 --set output.samples=40 --threads " +
                          std::to_string(threads);
    for (const std::string& change : fast_punch) command += " --set '" + change + "'";
    EXPECT_EQ(std::system((command + " >/dev/null").c_str()), 0) << command;
    return hdf5::File::open(place / name / "run.h5");
  }

  fs::path place;
};

// Compared as bits: as numbers, 0 equals -0.
std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

void expect_same_below(const std::string& group, const hdf5::File& a, const hdf5::File& b) {
  const auto names = a.datasets_below(group);
  ASSERT_EQ(names, b.datasets_below(group));
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    const std::string dataset = group + "/" + name;
    EXPECT_TRUE(bits_of(a.read_doubles(dataset)) == bits_of(b.read_doubles(dataset)))
        << dataset << " differs";
  }
}

TEST_F(ProgramDeterminism, RunFilesAgreeForOneTwoAndThreeThreads) {
  const auto one = run("one", 1);
  for (const int threads : {1, 2, 3}) {
    const auto other = run("with-" + std::to_string(threads), threads);
    expect_same_below("/history", one, other);
    ASSERT_EQ(one.children("/frames").size(), 5U);
    for (const std::string& frame : one.children("/frames")) {
      expect_same_below("/frames/" + frame, one, other);
      EXPECT_EQ(one.number_attribute("/frames/" + frame, "step"),
                other.number_attribute("/frames/" + frame, "step"));
    }
  }
}

}  // namespace
}  // namespace pulvis

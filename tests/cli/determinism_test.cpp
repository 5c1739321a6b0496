// A run gives the same bits with any number of threads, and every time: sums have a fixed order.
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>

#include "components/body.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/run_failure.hpp"
#include "systems/step_failure.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

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

Bits state_after(int threads, const std::string& formulation = "one-point",
                 const std::vector<std::string>& more = {}) {
  std::vector<std::string> changes = fast_punch;
  changes.push_back("element.formulation=" + formulation);
  changes.insert(changes.end(), more.begin(), more.end());
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

// Surfaces that indent, inerters and the estimate of the highest mode.
TEST(Determinism, ThreadsDoNotChangeABitOfStiffContacts) {
  const std::vector<std::string> stiff{"contact.stiffness=12", "contact.hardness=3"};
  const Bits one = state_after(1, "one-point", stiff);
  ASSERT_TRUE(one.contains("contact/indentation"));
  ASSERT_TRUE(one.contains("node/highest_mode"));
  expect_same(one, state_after(2, "one-point", stiff));
  expect_same(one, state_after(3, "one-point", stiff));
}

TEST(Determinism, ThreadsDoNotChangeABitOfFourPointElements) {
  const Bits one = state_after(1, "four-point");
  ASSERT_FALSE(one.contains("element/plastic_hourglass"));
  expect_same(one, state_after(2, "four-point"));
  expect_same(one, state_after(3, "four-point"));
}

TEST(StepFailure, TheFirstInTheListIsReportedWhicheverIsNoticedFirst) {
  StepFailure failure;
  EXPECT_FALSE(failure);
  failure.note(3, 1, "third system, chunk 1");
  failure.note(3, 0, "third system, chunk 0");
  failure.note(3, 2, "third system, chunk 2");
  EXPECT_EQ(failure.take(), "third system, chunk 0");
  failure.note(2, 7, "second system");
  failure.note(4, 0, "fourth system");
  EXPECT_EQ(failure.take(), "second system");
  EXPECT_FALSE(failure);
  failure.note(5, 0, "of another step");
  EXPECT_EQ(failure.take(), "of another step");
}

// A failed step is completed, as if the limit were out of the way: whatever else the threads were at, and in
// whichever order, the state is the same.
TEST(Determinism, AFailedStepIsCompletedOnAnyNumberOfThreads) {
  const std::vector<std::string> fast{"stage.press.duration=10 us",
                                      "stage.press.move[0].displacement=[\"0 mm\", \"-18 mm\"]"};
  std::vector<std::string> unlimited = fast;
  unlimited.emplace_back("limits.penetration=1e6");
  unlimited.emplace_back("limits.unconverged_projections=1");
  std::string first_failure, first_hash;
  for (const int threads : {1, 2, 3}) {
    Experiment failed("compaction/regular-25.toml", fast, threads);
    const std::string failure = message_of<RunFailure>([&] { failed.simulation.run_steps(10000); });
    ASSERT_NE(failure, "");
    const std::string hash = failed.simulation.state_hash();
    if (threads == 1) {
      first_failure = failure;
      first_hash = hash;
    }
    EXPECT_EQ(failure, first_failure) << threads;
    EXPECT_EQ(hash, first_hash) << threads;
    Experiment going("compaction/regular-25.toml", unlimited);
    going.simulation.run_steps(failed.simulation.clock().step + 1);
    const auto same = [&]<class C>() {
      const Column<C>&a = failed.column<C>(), &b = going.column<C>();
      return std::memcmp(a.values(), b.values(), a.bytes()) == 0;
    };
    EXPECT_TRUE(same.template operator()<Position<TwoD>>()) << threads;
    EXPECT_TRUE(same.template operator()<Velocity<TwoD>>()) << threads;
  }
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

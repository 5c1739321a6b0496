#include "bench/throughput/case.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "components/body.hpp"
#include "scenes/build.hpp"
#include "scenes/read.hpp"
#include "systems/step.hpp"

namespace pulvis::bench {
namespace {

constexpr double thesis_rate = 0.1 / 5.6e-3;  // 1/s: a tenth of the height in 5.6 ms
constexpr double crushing_rate = 20 * thesis_rate;
constexpr double max_pressing = 0.2;  // of the height: enough for a hundred rounds
constexpr int settling_steps = 600;

void resize(Scene& scene, int rows, int columns) {
  auto& packing = scene.packings.at(0);
  packing.cells[1] = rows;
  packing.cells[0] = columns;
  for (ToolSpec& tool : scene.tools) {
    if (tool.normal.x() < 0) tool.point.x() = columns * packing.spacing;
    if (tool.normal.y() < 0) tool.point.y() = rows * packing.spacing;
  }
}

StageSpec stage(const StageSpec& like, double height, double share, double rate) {
  StageSpec stage = like;
  stage.duration = share / rate;
  stage.moves.at(0).displacement = {0, -share * height, 0};
  stage.moves[0].ramp = 0;
  return stage;
}

// A node column of the particle in one slot.
template <class C>
class NodesOf {
 public:
  NodesOf(World& world, int slot)
      : column_(world.column<C>()),
        rows_(&column_.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]),
        lane_(slot % lane_count) {}
  int rows() const { return rows_[1] - rows_[0]; }
  double& operator()(int row, int component) const {
    return column_
        .values()[((std::ptrdiff_t{rows_[0]} + row) * C::count + component) * lane_count + lane_];
  }

 private:
  Column<C>& column_;
  const std::int32_t* rows_;
  int lane_;
};

void let_fall(World& world, double rate) {
  for (const int slot : world.resource<Bodies>().slot_of_number) {
    const NodesOf<Position<TwoD>> x(world, slot);
    const NodesOf<Velocity<TwoD>> v(world, slot);
    double height = 0;
    for (int n = 0; n < x.rows(); ++n) height += x(n, 1) / x.rows();
    for (int n = 0; n < v.rows(); ++n) v(n, 1) = -rate * height;
  }
}

void slow_down(World& world, double factor) {
  for (const int slot : world.resource<Bodies>().slot_of_number) {
    const NodesOf<Velocity<TwoD>> v(world, slot);
    for (int n = 0; n < v.rows(); ++n)
      for (int k = 0; k < 2; ++k) v(n, k) *= factor;
  }
}

}  // namespace

const std::vector<Case>& cases() {
  using enum Formulation;
  constexpr const char* regular = "compaction/regular-100.toml";
  static const std::vector<Case> all{
      {"100", regular, 0, 0, 0.03, 240, one_point},
      {"1683", regular, 33, 51, 0.03, 48, one_point},
      {"1683-hexagonal", "compaction/hexagonal-1683.toml", 0, 0, 0.03, 48, one_point},
      {"10000", regular, 100, 100, 0.03, 24, one_point},
      {"100-dense", regular, 0, 0, 0.1733, 240, one_point},  // relative density 0.95
      {"100-four-point", regular, 0, 0, 0.03, 240, four_point},
  };
  return all;
}

const Case& case_called(const std::string& name) {
  const auto found = std::ranges::find(cases(), name, &Case::name);
  if (found == cases().end()) throw std::invalid_argument("there is no case '" + name + "'");
  return *found;
}

Scene scene_of(const Case& c) {
  Scene scene = read_scene(std::string(PULVIS_SOURCE_DIR "/scenes/") + c.scene);
  scene.element.formulation = c.formulation;
  if (c.rows > 0) resize(scene, c.rows, c.columns);
  const StageSpec press = scene.stages.at(0);
  const double height = scene.tools.at(static_cast<std::size_t>(press.moves.at(0).tool)).point.y();
  scene.stages = {stage(press, height, c.compression, crushing_rate),
                  stage(press, height, max_pressing, thesis_rate)};
  return scene;
}

State::State(const Case& c, int threads) : case_(c) {
  const auto start = std::chrono::steady_clock::now();
  scene_ = scene_of(c);
  world_ = build_world(scene_);
  Workers workers(threads);
  workers.run([&] {
    let_fall(*world_, crushing_rate);
    Step step(*world_);
    step.start();
    step.run();
    startup_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    while (world_->resource<Clock>().time < scene_.stages[0].duration) step.run();
    slow_down(*world_, thesis_rate / crushing_rate);
    for (int i = 0; i < settling_steps; ++i) step.run();
  });
  const Bodies& bodies = world_->resource<Bodies>();
  for (const int slot : bodies.slot_of_number) elements_ += bodies.shape_of_slot(slot).elements();
}

}  // namespace pulvis::bench

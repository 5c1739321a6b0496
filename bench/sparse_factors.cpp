// Sparse factors of the levers' stiffness beside Eigen's simplicial ones: CPU seconds, the median of five on one core.
//
//   ./build/release/bench/sparse_factors [SCENE]...   (default: four shipped ones)
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>

#include "engine/processor_time.hpp"
#include "scenes/lever/afm_simulation.hpp"
#include "scenes/read.hpp"
#include "systems/lever/solid_equations.hpp"

namespace pulvis {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

template <class F>
double seconds_of(const F& f) {
  std::array<double, 5> all{};
  for (double& seconds : all) {
    const double before = process_seconds();
    f();
    seconds = process_seconds() - before;
  }
  std::ranges::sort(all);
  return all[2];
}

Matrix matrix_of(const SolidAssembly& assembly, const std::vector<double>& values) {
  std::vector<Eigen::Triplet<double>> entries;
  auto value = values.begin();
  for (int c = 0; c < assembly.columns(); ++c)
    for (int j = 0; j < 3; ++j)
      for (const int r : assembly.rows_of(c))
        for (int i = r == c ? j : 0; i < 3; ++i)
          entries.emplace_back(3 * r + i, 3 * c + j, *value++);
  Matrix matrix(3 * assembly.columns(), 3 * assembly.columns());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void compare(const std::string& scene) {
  AfmSimulation simulation(load_scene(scene).scene);
  simulation.calibrate();
  auto& own = simulation.world().resource<SolidEquations>().plain;
  const Matrix stiffness = matrix_of(simulation.world().resource<SolidAssembly>(), own.stiffness);
  Eigen::SimplicialLDLT<Matrix> eigen;
  eigen.analyzePattern(stiffness);
  const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(stiffness.rows(), 30);
  Eigen::MatrixXd x, y;
  const std::array seconds{seconds_of([&] { eigen.factorize(stiffness); }),
                           seconds_of([&] { own.factors->factorise(own.stiffness); }),
                           seconds_of([&] { x = eigen.solve(forces); }),
                           seconds_of([&] { y = own.solve(forces); })};
  fmt::print("| {} | {} | {:.3g} | {:.3g} | {:.1f} | {:.3g} | {:.3g} | {:.1f} | {:.0e} |\n",
             scene.substr(scene.rfind('/') + 1), stiffness.rows(), seconds[0], seconds[1],
             seconds[0] / seconds[1], seconds[2], seconds[3], seconds[2] / seconds[3],
             (x - y).norm() / x.norm());
}

}  // namespace
}  // namespace pulvis

int main(int count, char** words) {
  const std::string folder = std::string(PULVIS_SOURCE_DIR) + "/scenes/afm/";
  std::vector<std::string> scenes(words + 1, words + count);
  if (scenes.empty())
    for (const char* name : {"tipless-beam", "calibration-v", "hertz-ball", "plastic-probe"})
      scenes.push_back(folder + name + ".toml");
  fmt::print(
      "| scene | unknowns | factorisation: Eigen | Pulvis | ratio | 30 solutions: Eigen | Pulvis | "
      "ratio | "
      "difference |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& scene : scenes) pulvis::compare(scene);
}

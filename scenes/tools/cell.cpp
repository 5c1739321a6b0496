#include "scenes/tools/cell.hpp"

#include <algorithm>
#include <cmath>

#include "components/contact.hpp"
#include "components/servo.hpp"
#include "engine/portable_math.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/die_room.hpp"
#include "scenes/tools/powder.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {
namespace {

using Law = MixedControl::Law;
static_assert(tensor_parts == MixedControl::parts);

// `axes`: of the scene.
MixedControl::Stage stage_of(const StageSpec& spec, const CellDriveSpec& drive, int axes) {
  MixedControl::Stage stage;
  stage.duration = spec.duration;
  stage.ramp = drive.ramp;
  stage.rise = drive.rise * spec.duration;
  stage.tolerance = drive.tolerance;
  stage.rotation = {drive.rotation.x(), drive.rotation.y(), drive.rotation.z()};
  for (std::size_t k = 0; k < tensor_parts; ++k) {
    stage.strain[k] = drive.strain[k].value_or(0);
    stage.stress[k] = drive.stress[k].value_or(0);
    stage.law[k] = drive.stress[k] ? Law::stress : Law::strain;
  }
  if (!drive.stress_ratio && !drive.mean_stress) return stage;
  for (std::size_t lateral = 0; lateral + 1 < static_cast<std::size_t>(axes); ++lateral) {
    stage.law[lateral] = drive.stress_ratio ? Law::ratio : Law::mean;
    stage.stress[lateral] = drive.stress_ratio ? *drive.stress_ratio : *drive.mean_stress;
  }
  return stage;
}

// The inertia for a strain, kg m^2, and the dashpot, N m s: those of a punch of the cell's size on a lever arm of
// its size (scenes/tools/drives.cpp), since a displacement is strain times size. `size`: m^2 or m^3, of the cell.
template <class D>
void tune(MixedControl::Stage& stage, double response, const Powder& powder, double size,
          double thickness) {
  const double share = response / (1 + kernels::dragged_mass);
  const double edge = D::axes == 2 ? std::sqrt(size) : portable::cbrt(size);
  const double wave = powder.impedance * size / edge * thickness;  // of a side
  stage.mass = share * powder.mass * edge * edge;
  stage.damping = 0.5 * std::sqrt(kernels::dragged_mass * share) * wave * edge * edge;
}

template <class D>
MixedControl control_of(const Powder& powder, const Scene& scene, double size) {
  MixedControl control;
  control.axes = D::axes;
  for (const StageSpec& spec : scene.stages) {
    const CellDriveSpec drive = spec.cell.value_or(CellDriveSpec{});
    control.stages.push_back(stage_of(spec, drive, D::axes));
    tune<D>(control.stages.back(), drive.response, powder, size, thickness_of<D>(scene));
  }
  return control;
}

// Tools on both sides along each axis.
std::vector<DrivenWalls::Axis> walls_of(const Scene& scene) {
  if (!scene.in_space()) {
    const DieCell die = *die_cell(scene);
    return {{die.left, die.right}, {die.bottom, die.top}};
  }
  const DieRoom room = *die_room(scene);
  std::vector<DrivenWalls::Axis> walls;
  for (std::size_t k = 0; k < room.tool.size(); k += 2)
    walls.push_back({room.tool[k], room.tool[k + 1]});
  return walls;
}

}  // namespace

std::vector<Vec3> cell_vectors(const CellSpec& cell) {
  if (cell.depth) return {{cell.width, 0, 0}, {0, *cell.depth, 0}, {0, 0, *cell.height}};
  const double c = portable::cos(cell.angle), s = portable::sin(cell.angle);
  return {cell.width * Vec3(c, s, 0), *cell.height * Vec3(-s, c, 0)};
}

double size_of_cell(const CellSpec& cell) {
  return cell.width * cell.depth.value_or(1) * *cell.height;
}

template <class D>
void add_cell(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (!scene.cell) return;
  world.add<ContactImage<typename D::Contact>>();
  world.add<MassCentre<D>>();
  world.add<NetForce<D>>();
  world.add<StrainResistance>();
  world.add<KickWork>();
  const Powder powder = powder_of<D>(world, scene, bodies);
  auto& cell = world.emplace<PeriodicCell<D>>();
  const std::vector<Vec3> vectors = cell_vectors(*scene.cell);
  typename D::Point from_centre;
  for (std::size_t i = 0; i < D::axes; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < D::axes; ++j) cell.vectors(i, j) = vectors[j][axis];
    cell.centre[i] = powder.centre[axis];
    from_centre[i] = scene.cell->corner[axis] - cell.centre[i];
  }
  cell.corner = cell.vectors.inverse() * from_centre;
  cell.thickness = thickness_of<D>(scene);
  cell.control = control_of<D>(powder, scene, cell.size());
}
template void add_cell<TwoD>(World&, const Scene&, const std::vector<BodySpec>&);
template void add_cell<ThreeD>(World&, const Scene&, const std::vector<BodySpec>&);

bool drives_walls(const Scene& scene) {
  return !scene.cell &&
         std::ranges::any_of(scene.stages, [](const StageSpec& s) { return s.cell.has_value(); });
}

template <class D>
void add_driven_walls(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (!drives_walls(scene)) return;
  const double* at = world.column<ToolPosition>().values();
  world.add<ServoTravel>();
  world.add<ServoVelocity>();
  DrivenWalls& walls = world.emplace<DrivenWalls>();
  walls.walls = walls_of(scene);
  walls.thickness = thickness_of<D>(scene);
  double size = 1;
  for (std::size_t k = 0; k < walls.walls.size(); ++k) {
    const auto [low, high] = walls.walls[k];
    size *= at[tool_axes * static_cast<std::size_t>(high) + k] -
            at[tool_axes * static_cast<std::size_t>(low) + k];
  }
  walls.control = control_of<D>(powder_of<D>(world, scene, bodies), scene, size);
}
template void add_driven_walls<TwoD>(World&, const Scene&, const std::vector<BodySpec>&);
template void add_driven_walls<ThreeD>(World&, const Scene&, const std::vector<BodySpec>&);

const MixedControl* mixed_control_of(const World& world) {
  const MixedControl* control = nullptr;
  if (with_cell_of(world, [&](const auto& cell) { control = &cell.control; })) return control;
  return world.has<DrivenWalls>() ? &world.resource<DrivenWalls>().control : nullptr;
}

}  // namespace pulvis

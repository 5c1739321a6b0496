#include "scenes/tools/cell.hpp"

#include <algorithm>
#include <cmath>

#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/servo.hpp"
#include "engine/portable_math.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/powder.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {
namespace {

Point centre_of_mass(const Scene& scene, const std::vector<BodySpec>& bodies) {
  Vec2 sum = Vec2::Zero();
  double mass = 0;
  for (const BodySpec& body : bodies) {
    const ParticleSpec& particle = scene.class_of(body);
    const double m = scene.materials[static_cast<std::size_t>(particle.material)].density *
                     outline_area(particle.outline);
    sum += m * in_plane(body.position);
    mass += m;
  }
  return {sum.x() / mass, sum.y() / mass};
}

using Law = MixedControl::Law;

MixedControl::Stage stage_of(const StageSpec& spec, const CellDriveSpec& drive) {
  MixedControl::Stage stage;
  stage.duration = spec.duration;
  stage.ramp = drive.ramp;
  stage.rise = drive.rise * spec.duration;
  stage.tolerance = drive.tolerance;
  stage.rotation = drive.rotation;
  stage.strain = {drive.strain_xx.value_or(0), drive.strain_yy.value_or(0),
                  drive.strain_xy.value_or(0)};
  const auto law = [](bool stress) { return stress ? Law::stress : Law::strain; };
  stage.law = {drive.stress_ratio  ? Law::ratio
               : drive.mean_stress ? Law::mean
                                   : law(drive.stress_xx.has_value()),
               law(drive.stress_yy.has_value()), law(drive.stress_xy.has_value())};
  const double xx = drive.stress_xx.value_or(0);
  stage.stress = {drive.stress_ratio.value_or(drive.mean_stress.value_or(xx)),
                  drive.stress_yy.value_or(0), drive.stress_xy.value_or(0)};
  return stage;
}

// The inertia for a strain, kg m^2, and the dashpot, N m s: those of a punch of the cell's size on a lever arm of
// its size (scenes/tools/drives.cpp), since a displacement is strain times size.
void tune(MixedControl::Stage& stage, double response, const Powder& powder, double area,
          double thickness) {
  const double share = response / (1 + kernels::dragged_mass);
  const double wave = powder.impedance * std::sqrt(area) * thickness;
  stage.mass = share * powder.mass * area;
  stage.damping = 0.5 * std::sqrt(kernels::dragged_mass * share) * wave * area;
}

MixedControl control_of(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies,
                        double area) {
  const Powder powder = powder_of<TwoD>(world, scene, bodies);
  MixedControl control;
  for (const StageSpec& spec : scene.stages) {
    const CellDriveSpec drive = spec.cell.value_or(CellDriveSpec{});
    control.stages.push_back(stage_of(spec, drive));
    tune(control.stages.back(), drive.response, powder, area, scene.thickness);
  }
  return control;
}

}  // namespace

std::array<Vec2, 2> cell_vectors(const CellSpec& cell) {
  const double c = portable::cos(cell.angle), s = portable::sin(cell.angle);
  return {cell.width * Vec2(c, s), *cell.height * Vec2(-s, c)};
}

void add_cell(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (!scene.cell) return;
  world.add<ContactImage>();
  world.add<MassCentre>();
  world.add<NetForce>();
  world.add<StrainResistance>();
  world.add<KickWork>();
  PeriodicCell& cell = world.emplace<PeriodicCell>();
  const auto [first, second] = cell_vectors(*scene.cell);
  cell.vectors = {{first.x(), second.x(), first.y(), second.y()}};
  cell.centre = centre_of_mass(scene, bodies);
  const Vec2& corner = scene.cell->corner;
  cell.corner =
      cell.vectors.inverse() * Point{corner.x() - cell.centre[0], corner.y() - cell.centre[1]};
  cell.thickness = scene.thickness;
  cell.control = control_of(world, scene, bodies, cell.area());
}

bool drives_walls(const Scene& scene) {
  return !scene.cell &&
         std::ranges::any_of(scene.stages, [](const StageSpec& s) { return s.cell.has_value(); });
}

void add_driven_walls(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (!drives_walls(scene)) return;
  const DieCell die = *die_cell(scene);
  const double* at = world.column<ToolPosition>().values();
  const double width = at[tool_axes * die.right] - at[tool_axes * die.left];
  const double height = at[tool_axes * die.top + 1] - at[tool_axes * die.bottom + 1];
  world.add<ServoTravel>();
  world.add<ServoVelocity>();
  DrivenWalls& walls = world.emplace<DrivenWalls>();
  walls.left = die.left, walls.right = die.right, walls.bottom = die.bottom, walls.top = die.top;
  walls.thickness = scene.thickness;
  walls.control = control_of(world, scene, bodies, width * height);
}

}  // namespace pulvis

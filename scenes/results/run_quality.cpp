#include "scenes/results/run_quality.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "components/contact.hpp"
#include "components/servo.hpp"
#include "scenes/spec/elastic_response.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/tools/cell.hpp"

namespace pulvis {
namespace {

constexpr double most_hourglass = 0.03;     // of the internal energy, in two dimensions
constexpr double most_node_distance = 0.5;  // of a face
constexpr double most_kinetic = 0.1;        // of the internal energy: quasi-static practice

// Advice, in the order of the figures.
constexpr const char* of_energy_balance =
    "use smaller steps (a lower time.safety), or more elements where they are most distorted";
constexpr const char* of_kinetic_energy =
    "move the tools more slowly: longer stages, or a longer ramp of their moves; for a run that is "
    "dynamic on purpose, set limits.kinetic_energy to what it may reach";
constexpr const char* of_overshoot =
    "the powder keeps what it was pressed by: use a longer stage, or a smaller "
    "stage.servo.max_speed";
constexpr const char* of_stress_overshoot =
    "the powder keeps what it was pressed by: use a longer stage, or a smaller stage.cell.response";
constexpr const char* of_projections =
    "outlines turn too sharply for their boundary edges: use more of them (boundary_edges)";
constexpr const char* of_projections_in_space =
    "surfaces turn too sharply for their faces: use more of them (particle.mesh.divisions)";
constexpr const char* of_node_distance =
    "the smooth surface does not follow the mesh: use smaller faces (particle.mesh.divisions)";

std::string percent(double share) { return fmt::format("{:.3g}%", 100 * share); }

std::string of_hourglass(const Scene& scene) {
  return fmt::format(
      "the mesh is too coarse for the bending in it: use more elements ({}, in place of "
      "`accuracy`), or element.formulation = \"four-point\"",
      refining_keys(scene));
}

std::string stiffer(const Scene& scene, const ContactFindings& contacts) {
  if (contacts.stiffness_to_do() <= scene.contact.stiffness)
    return scene.in_space()
               ? "use smaller faces (particle.mesh.divisions): the contacts are already as "
                 "stiff as possible"
               : "use shorter boundary edges (boundary_edges): the contacts are already as "
                 "stiff as possible";
  // For powders: soft springs offset the extra force due to coarse faces (docs/accuracy.md).
  return fmt::format(
      "use contact.stiffness = {:g}{}", contacts.stiffness_to_do(),
      scene.in_space() && any_material_yields(scene)
          ? ", with smaller faces (particle.mesh.divisions): coarse ones carry too much force"
          : "");
}

// Two digits, without an exponent.
std::string short_number(double value) {
  return fmt::format("{:g}", std::stod(fmt::format("{:.2g}", value)));
}

std::string finer(const Scene& scene, const ContactFindings& contacts) {
  const bool space = scene.in_space();
  return fmt::format(
      "the mesh is too coarse for them, they are {} {} wide on average: use {} of {}{} um{}",
      short_number(contacts.narrow_edges), space ? "faces" : "boundary edges",
      space ? "faces" : "edges", contacts.too_soft() ? "at most " : "",
      short_number(1e6 * contacts.edge_to_do), space ? " (particle.mesh.divisions)" : "");
}

std::string for_elastic_response(const Scene& scene, const ContactFindings& contacts) {
  const std::string what = "the elastic response is too soft by as much: ";
  if (scene.contact.stiffness < stiff_contacts) return what + "use " + advice_of_stiff_contacts();
  return what + stiffer(scene, contacts);
}

// Free bodies that fly, spin or collide are not quasi-static, nor meant to be.
bool starts_moving(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const BodySpec& body) {
    return body.velocity.norm() > 0 || body.angular_velocity.norm() > 0;
  });
}

class Figures {
 public:
  void add(const char* name, const std::string& meaning, double value, std::optional<double> limit,
           const std::string& advice) {
    if (!std::isfinite(value)) return;
    QualityFigure figure{name, meaning, value, limit, {}};
    if (figure.beyond()) figure.advice = advice;
    all.push_back(std::move(figure));
  }

  std::vector<QualityFigure> all;
};

void add_kinetic_energy(Figures& figures, const Scene& scene, const Results& results) {
  const bool flies = starts_moving(scene) && !scene.limits.kinetic_energy;
  figures.add(
      "Kinetic energy",
      flies ? "kinetic energy, relative to the internal energy, under more than a tenth of "
              "the largest load; not judged, since bodies start with a velocity"
            : "kinetic energy, relative to the internal energy, under more than a tenth of "
              "the largest load",
      results.kinetic_ratio(),
      flies ? std::nullopt : std::optional(scene.limits.kinetic_energy.value_or(most_kinetic)),
      of_kinetic_energy);
}

// In all scenes that unload, judged in those that do so on purpose.
void add_release(Figures& figures, const Scene& scene, const Results& results,
                 const ContactFindings& contacts) {
  const auto share = results.released_by_springs();
  if (!share) return;
  const bool judged = asks_for_elastic_response(scene).has_value();
  figures.add(release_figure,
              "share of the energy released on unloading that was stored in contact springs: the "
              "elastic response is too soft by as much",
              *share, judged ? std::optional(most_in_springs) : std::nullopt,
              for_elastic_response(scene, contacts));
}

void add_lost_force(Figures& figures, const Scene& scene, const ContactFindings& contacts) {
  if (!contacts.force_error) return;
  figures.add("Force error due to penalty penetration",
              "error of the largest force, too low because surfaces penetrate each other",
              std::max(0.0, -*contacts.force_error), ContactFindings::max_force_error,
              stiffer(scene, contacts));
}

void add_contacts(Figures& figures, const Scene& scene, const ContactFindings& contacts) {
  add_lost_force(figures, scene, contacts);
  if (!contacts.narrow_share) return;
  const bool space = scene.in_space();
  figures.add(space ? "Contacts narrower than two faces" : "Contacts narrower than two edges",
              fmt::format("share of the largest contact force carried by contacts narrower than "
                          "two {}",
                          space ? "faces" : "boundary edges"),
              *contacts.narrow_share, contacts.narrow_limit(), finer(scene, contacts));
}

// The servo that passed its target most, relative to its tolerance.
struct Overshoot {
  double value = 0, tolerance = 1;  // -

  void see(const ServoWatch& watch, double of_tolerance) {
    if (watch.overshoot * tolerance > value * of_tolerance)
      value = watch.overshoot, tolerance = of_tolerance;
  }
  void see(const MixedControl& control) {
    for (const MixedControl::Stage& stage : control.stages)
      if (stage.holds_stress())
        for (const ServoWatch& watch : control.watches) see(watch, stage.tolerance);
  }
};

void add_overshoots(Figures& figures, const World& world) {
  constexpr const char* meaning =
      "largest force of a servo, or stress of a cell, beyond both its target and where it began, "
      "relative to the larger of these";
  Overshoot of_tools, of_cells;
  if (world.has<ToolServos>()) {
    const ToolServos& servos = world.resource<ToolServos>();
    for (std::size_t i = 0; i < servos.servos.size(); ++i)
      if (servos.servos[i].holds_force())
        of_tools.see(servos.watches[i], servos.servos[i].tolerance);
  }
  if (const MixedControl* control = mixed_control_of(world)) of_cells.see(*control);
  const bool of_cell = of_cells.value > 0;
  const Overshoot& worst = of_cell ? of_cells : of_tools;
  if (worst.value > 0)
    figures.add("Overshoot", meaning, worst.value, worst.tolerance,
                of_cell ? of_stress_overshoot : of_overshoot);
}

// Contact figures in three dimensions.
void add_contacts_in_space(Figures& figures, const Scene& scene, const Totals& totals,
                           const Peaks& peaks, const ContactFindings& contacts) {
  figures.add(
      "Penetration", "deepest overlap of two surfaces, relative to the size of a face",
      peaks.penetration, scene.limits.penetration,
      "use stiffer contacts (contact.stiffness), or smaller faces (particle.mesh.divisions)");
  figures.add(
      "Unconverged projections",
      "share of closest-point projections between contacting surfaces that did not converge",
      totals.unconverged_share(), scene.limits.unconverged_projections, of_projections_in_space);
  figures.add("Surface nodes off the contact surface",
              "largest distance of a surface node from the smooth surface that is in contact, "
              "relative to the size of a face: such nodes may be beyond a tool",
              peaks.node_distance, most_node_distance, of_node_distance);
  add_contacts(figures, scene, contacts);
}

}  // namespace

std::string refining_keys(const Scene& scene) {
  if (scene.in_space()) return "divisions and rings of [particle.mesh]";
  bool counts = false, rows = false, size = false, grains = false;
  for (const ParticleSpec& particle : scene.particles) {
    const bool in_rows = std::holds_alternative<RectangleMesh>(particle.mesh);
    (particle.grains ? grains : particle.mesh_size ? size : in_rows ? rows : counts) = true;
  }
  std::string keys;
  const auto add = [&](bool used, const char* more) {
    if (used) keys += (keys.empty() ? "" : "; ") + std::string(more);
  };
  add(counts, "boundary_edges and rings of [particle.mesh]");
  add(rows, "columns and rows of [particle.mesh]");
  add(size, "a smaller size of [particle.mesh]");
  add(grains, "edges of [particle.grains]");
  return keys;
}

std::string QualityFigure::line() const {
  std::string text = name;
  text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  text += " " + percent(value);
  if (limit) text += " (limit " + percent(*limit) + ")";
  return advice.empty() ? text : text + ": " + advice;
}

std::vector<QualityFigure> run_quality(const Scene& scene, const World& world,
                                       const Results& results, const ContactFindings& contacts) {
  Figures figures;
  const LimitSpec& limits = scene.limits;
  const Peaks& peaks = results.peaks();
  const Totals& totals = world.resource<Totals>();
  figures.add("Energy balance error",
              "energy lost or gained numerically, relative to the largest energy in the run",
              results.energy_balance_error(), limits.energy_balance, of_energy_balance);
  add_kinetic_energy(figures, scene, results);
  add_overshoots(figures, world);
  add_release(figures, scene, results, contacts);
  // Hexahedra have no limit: at contacts of a few faces none of their meshes meets that of quads (docs/accuracy.md).
  const std::optional<double> hourglass_limit =
      scene.in_space() ? std::nullopt : std::optional(most_hourglass);
  if (const double internal = std::max(peaks.elastic, peaks.plastic); internal > 0)
    figures.add(
        "Hourglass energy",
        "largest hourglass energy, including plastic work, relative to the largest internal energy",
        peaks.hourglass / internal, hourglass_limit, of_hourglass(scene));
  if (scene.in_space() && world.has<ContactRules>())
    add_contacts_in_space(figures, scene, totals, peaks, contacts);
  if (scene.in_space() || !world.has<ContactQuality>()) return figures.all;
  figures.add("Penetration",
              "deepest overlap of two surfaces, relative to the length of a boundary edge",
              peaks.penetration, limits.penetration, stiffer(scene, contacts));
  figures.add(
      "Unconverged projections",
      "share of closest-point projections between contacting outlines that did not converge",
      totals.unconverged_share(), limits.unconverged_projections, of_projections);
  add_contacts(figures, scene, contacts);
  return figures.all;
}

}  // namespace pulvis

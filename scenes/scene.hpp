// A scene as the program sees it once its file has been read and refused or accepted: plain values,
// SI units, names resolved to positions in the lists below. Nothing here runs; scenes/build.* turns it
// into tables, columns and systems.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pulvis {

using Vec2 = Eigen::Vector2d;

// One place of a scene file, kept with every object so that errors found after reading (an overlap, a
// particle outside the die) still point at the line that caused them.
struct SourceMark {
  int line = 0;
  int column = 0;
};

struct MaterialSpec {
  std::string name;
  double density = 0;                  // kg/m^3, > 0
  double youngs_modulus = 0;           // Pa, > 0
  double poissons_ratio = 0;           // -, in (-1, 0.5)
  std::optional<double> yield_stress;  // Pa, > 0; absent: elastic
  double hardening_modulus = 0;        // Pa, >= 0; dsigma_y/deps_p; 0: perfectly plastic
  SourceMark mark;
};

struct DiscOutline {
  double diameter = 0;  // m
};
struct RectangleOutline {
  double width = 0;   // m, along the particle's own x axis
  double height = 0;  // m
};
using Outline = std::variant<DiscOutline, RectangleOutline>;

struct DiscMesh {
  int boundary_edges =
      40;         // a multiple of 4, >= 8: the O-grid's core has (boundary_edges/4)^2 quads
  int rings = 1;  // rings of quads between the core and the outline, >= 1
  double refinement =
      1;  // >= 1: edges at the poles (top and bottom) are this much finer than at the equator
};
struct RectangleMesh {
  int columns = 8;  // quads along the width
  int rows = 8;     // quads along the height
};
using MeshSpec = std::variant<DiscMesh, RectangleMesh>;

struct ParticleSpec {  // a class of equal particles
  std::string name;
  int material = 0;  // position in Scene::materials
  Outline outline;
  MeshSpec mesh;
  bool random_mesh_phase =
      false;              // every particle's mesh turned by its own random angle (disc only)
  double mesh_phase = 0;  // rad, the same turn for all when not random (disc only)
  SourceMark mark;
};

struct BodySpec {                // one particle, placed by hand
  int particle = 0;              // position in Scene::particles
  Vec2 position = Vec2::Zero();  // m, centre of the outline
  double angle = 0;              // rad, counter-clockwise
  Vec2 velocity = Vec2::Zero();  // m/s
  double angular_velocity = 0;   // rad/s
  SourceMark mark;
};

struct SquarePacking {  // rows x columns on a square lattice
  int particle = 0;
  int rows = 1;
  int columns = 1;
  double spacing = 0;          // m, centre to centre
  Vec2 corner = Vec2::Zero();  // m, lower left corner of the first particle's lattice cell
  SourceMark mark;
};

struct ToolSpec {  // rigid; fills the half-plane behind `point`, its surface looks along `normal`
  std::string name;
  Vec2 point = Vec2::Zero();    // m
  Vec2 normal = Vec2::UnitY();  // unit vector, from the tool into the powder
  SourceMark mark;
};

struct MoveSpec {
  int tool = 0;                      // position in Scene::tools
  Vec2 displacement = Vec2::Zero();  // m, travelled over the stage
  double ramp =
      0.1;  // -, share of the stage in which the speed rises smoothly from zero, and falls again at its end
  SourceMark mark;
};

struct StageSpec {
  std::string name;
  enum class Kind { settle, compact, hold, unload } kind = Kind::hold;
  double duration = 0;  // s
  std::vector<MoveSpec> moves;
  SourceMark mark;
};

struct FrictionSpec {  // overrides ContactSpec::friction for one pair of names (materials or tools)
  std::string first, second;
  double coefficient = 0;
  SourceMark mark;
};

struct ContactSpec {
  double friction = 0;  // -, Coulomb coefficient of every pair that no [[friction]] names
  // k of kappa = k K L/A (bulk modulus, boundary edge length, element area). 0.5: softer, the penetration
  // delays the lateral force; stiffer, the force depends on where the mesh nodes lie (docs/accuracy.md).
  double stiffness = 0.5;
  double damping = 0;  // -, share of the critical damping of the contact spring (T 5.1, 5.2)
};

struct TimeSpec {
  double safety = 0.9;  // -, share of the stable time step that is used, in (0, 1)
};

struct ElementSpec {
  enum class Formulation { four_point, one_point, standard } formulation = Formulation::four_point;
};

struct OutputSpec {
  int frames = 50;     // fields written over the run, besides the first
  int samples = 1000;  // history rows over the run, besides the first
};

struct LimitSpec {               // health: a run that passes one of these stops
  double energy_balance = 0.05;  // -, |balance| / largest energy of the run
  double penetration = 0.5;      // -, penetration / boundary edge length
  std::optional<double>
      kinetic_energy;  // -, kinetic / internal energy, where the scene asks for quasi-statics
};

struct Scene {
  std::filesystem::path file;
  std::string title;
  double thickness = 1e-3;  // m, of the plane-strain slice: forces are in N
  std::uint64_t seed = 1;
  std::vector<MaterialSpec> materials;
  std::vector<ParticleSpec> particles;
  std::vector<BodySpec> bodies;         // [[body]]
  std::vector<SquarePacking> packings;  // [[packing]]
  std::vector<ToolSpec> tools;          // [[tool]]
  std::vector<StageSpec> stages;        // [[stage]]
  std::vector<FrictionSpec> frictions;  // [[friction]]
  ContactSpec contact;
  ElementSpec element;
  TimeSpec time;
  OutputSpec output;
  LimitSpec limits;
};

}  // namespace pulvis

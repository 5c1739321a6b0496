// A scene as the program sees it after its file has been read and checked: plain values,
// SI units, names resolved to positions in the lists below. Nothing here runs; scenes/build.* turns it
// into tables, columns and systems.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/formulation.hpp"
#include "components/surface_laws.hpp"
#include "engine/enum_table.hpp"
#include "scenes/language/source_mark.hpp"
#include "scenes/language/vectors.hpp"
#include "scenes/spec/cell_spec.hpp"
#include "scenes/spec/particle_shape.hpp"
#include "scenes/spec/profile_spec.hpp"
#include "scenes/spec/results_spec.hpp"
#include "scenes/spec/rotation.hpp"

namespace pulvis {

struct FlowLaw;  // systems/laws/flow_law.hpp

struct MaterialSpec {
  std::string name;
  double density = 0;                   // kg/m^3, > 0
  double youngs_modulus = 0;            // Pa, > 0
  double poissons_ratio = 0;            // -, in (-1, 0.5)
  std::optional<double> yield_stress;   // Pa, > 0; absent: elastic
  double hardening_modulus = 0;         // Pa, >= 0; dsigma_y/deps_p; 0: perfectly plastic
  std::shared_ptr<const FlowLaw> flow;  // set if it is any other law
  SourceMark mark;
  double mass_damping = 0;       // 1/s, alpha of Rayleigh damping
  double stiffness_damping = 0;  // s, beta
  bool damped() const { return mass_damping > 0 || stiffness_damping > 0; }
};

// Meshes and outlines. Each outline names its mesh type; scenes/outlines/outline.cpp knows its geometry,
// scenes/meshes/mesh_<outline>.cpp meshes it, scenes/keys/declare_particle.cpp and declare_mesh.cpp declare its keys.
struct DiscMesh {
  int boundary_edges = 40;  // a multiple of 4, with a coarse core of 12
  int rings = 1;  // of quads between the core and the outline; 0: the core's rim is the outline
  double refinement =
      1;  // >= 1: edges at top and bottom are finer than at the sides by this factor
  enum class Core {
    even,  // (boundary_edges/4)^2 quads
    coarse,  // (boundary_edges/12)^2, and a ring of transition quads: one core edge for three outline edges
  } core = Core::even;
};
struct RectangleMesh {
  int columns = 8;  // quads along the width
  int rows = 8;     // quads along the height
};
struct RoundedRectangleMesh {
  int boundary_edges = 48;  // a multiple of 4
  int rings = 1;            // >= 1
};
struct RingMesh {
  int boundary_edges = 40;  // a multiple of 4
  int rings = 4;            // layers of quads through the wall, >= 1
};
struct StarMesh {           // of any star-shaped outline
  int boundary_edges = 48;  // a multiple of 4
  int rings = 1;            // >= 1
};
using MeshSpec = std::variant<DiscMesh, RectangleMesh, RoundedRectangleMesh, RingMesh, StarMesh>;

struct DiscOutline {
  using Mesh = DiscMesh;
  double diameter = 0;  // m
};
struct RectangleOutline {
  using Mesh = RectangleMesh;
  double width = 0;   // m, along the particle's local x axis
  double height = 0;  // m
};
struct RoundedRectangleOutline {
  using Mesh = RoundedRectangleMesh;
  double width = 0;   // m, along the particle's local x axis
  double height = 0;  // m
  double radius = 0;  // m, of the four corners; at most half the shorter side
};
struct RingOutline {  // a tube; nothing touches its inner surface
  using Mesh = RingMesh;
  double diameter = 0;  // m
  double hole = 0;      // m, diameter of the hole
};
struct EllipseOutline {
  using Mesh = StarMesh;
  double width = 0;   // m, along the particle's local x axis
  double height = 0;  // m
};
struct SuperellipseOutline {  // |2x/width|^exponent + |2y/height|^exponent = 1
  using Mesh = StarMesh;
  double width = 0;     // m
  double height = 0;    // m
  double exponent = 2;  // -
};
// Given by its corners, or regular: `sides` sides in a circle of this diameter, one side at the bottom.
struct PolygonOutline {
  using Mesh = StarMesh;
  int sides = 0;        // 0: given by corners
  double diameter = 0;  // m
  std::vector<Vec2> corners =
      {};                 // m, in either order of rotation; the centroid becomes the origin
  double rounding = 0;    // m, radius of all corners; 0: sharp
  bool mirrored = false;  // x -> -x
};
// A closed C2 curve (periodic cubic spline) through or near measured points.
struct PointsOutline {
  using Mesh = StarMesh;
  std::string file = {};             // CSV, relative to the scene
  std::string unit = {};             // of its numbers, if its header gives none
  std::string layer = {};            // of a drawing: the layer with the outline; empty: all of it
  std::vector<Vec2> points = {};     // m, as in the file
  double smoothing = 0;              // m, root mean square distance of the curve from the points
  std::optional<double> width = {};  // m, size to scale to, at most one of these: the extent in x,
  std::optional<double> diameter = {};  // m, the diameter of the circle of equal area,
  std::optional<double> area = {};      // m^2
  bool mirrored = false;                // x -> -x
};
// Irregular: radius over polar angle with given spectral amplitudes and random phases, then stretched.
struct FourierOutline {
  using Mesh = StarMesh;
  double diameter = 0;        // m, of the circle of equal area
  double aspect_ratio = 1;    // -, stretch along the particle's local x axis relative to y
  double irregularity = 0;    // -, amplitude of mode 3 over the mean radius
  double roughness = 0;       // -, of mode 8
  double decay = 2;           // -, exponent with which both decay with the mode number
  int modes = 16;             // highest mode of the roughness
  std::uint64_t variant = 1;  // seed of the phases
};
class OutlineCurve;  // scenes/outlines/outline_curve.hpp

// One grain of a particle: its faces to other grains are straight, the others lie on the particle's outline. Scenes
// cannot name it (scenes/grains).
struct GrainOutline {
  using Mesh = StarMesh;
  struct Face {
    Vec2 from = Vec2::Zero();   // m, in the particle's frame
    double begin = 0, end = 0;  // m, along the particle's outline; both 0: straight
    int edges = 1;              // of the mesh
    bool on_outline() const { return begin != end; }
  };
  std::vector<Face> faces = {};
  std::shared_ptr<const OutlineCurve> particle = {};
};
using Outline = std::variant<DiscOutline, RectangleOutline, RoundedRectangleOutline, RingOutline,
                             EllipseOutline, SuperellipseOutline, PolygonOutline, PointsOutline,
                             FourierOutline, GrainOutline>;

struct GrainsSpec {  // the grains of a particle: a Voronoi tessellation
  std::optional<int> number;
  std::optional<double> size;  // m, mean: diameter of the circle of mean grain area
  int variants = 4;            // tessellations that the particles of a class share
  int relaxation = 5;          // steps of Lloyd's method
  double aspect_ratio = 1;     // -
  double direction = 0;        // rad, of the long axis
  int edges = 12;              // of the mesh around an average grain
};
struct GrainPlace {
  int grain;  // index in Scene::grains
  Vec2 at;    // m, its centre in the frame of the particle
};

struct ParticleSpec {  // a class of identical particles
  std::string name;
  int material = 0;  // index in Scene::materials
  Outline outline;   // in two dimensions
  MeshSpec mesh;
  bool random_mesh_phase =
      false;  // rotate every particle's mesh by its own random angle (disc, ring), or rotation (sphere)
  double mesh_phase = 0;  // rad, the same rotation for all if not random (disc, ring)
  SourceMark mark;
  std::optional<double> mesh_size = {};  // m, edge length; the counts in `mesh` follow from it
  int class_of = -1;  // for one size of a packing: the class that is scaled, in Scene::particles
  double scale = 1;   // factor on that class's shape
  std::optional<GrainsSpec> grains = {};
  // [variants][grains], set once the scene has been read.
  std::vector<std::vector<GrainPlace>> tessellations = {};
  ParticleShape shape = {};  // in three dimensions
  HexMeshSpec hex_mesh = {};
};

struct BodySpec {                            // one particle, placed individually
  int particle = 0;                          // index in Scene::particles
  Vec3 position = Vec3::Zero();              // m, centre of the outline or of the volume
  double angle = 0;                          // rad, counter-clockwise; in two dimensions
  Rotation rotation = Rotation::Identity();  // from its local frame to the scene's; in three
  Vec3 velocity = Vec3::Zero();              // m/s
  Vec3 angular_velocity = Vec3::Zero();      // rad/s, in the scene's frame
  SourceMark mark;
  int parent = -1;  // of a grain: the particle's number in the order of placement
};

// By number: uniform, normal, log-normal; by area: sieve. The size of a particle is the minimum width of its
// outline, which determines the sieve that it passes.
struct SizeLaw {
  enum class Kind { mono, uniform, normal, lognormal, sieve } kind = Kind::mono;
  double mean = 0;                         // m, of the whole law, before truncation
  double deviation = 0;                    // m, standard deviation of the size itself
  std::optional<double> minimum, maximum;  // m, the law is truncated here
  std::string file;                        // sieve curve, relative to the scene's folder
  int sizes = 8;                           // number of discrete sizes that represent the law
};

// Part of a random packing: particles of one class and their sizes.
struct MixtureClass {
  int particle = 0;                        // index in Scene::particles
  std::optional<int> number;               // one of these three
  std::optional<double> number_fraction;   // -, of all particles
  std::optional<double> content_fraction;  // -, of their total area or volume
  SizeLaw size;
  SourceMark mark;
};

struct PackingReached {  // the result of a random packing
  double density = 0;  // -, area of the particles over that of the die up to the top of the packing
  double mean_gap = 0;  // -, to the three nearest neighbours, in diameters
  double min_gap = 0;   // m, between any two particles, or a particle and the die
  int touches = 0;      // pairs of particles with a gap below a thousandth of a diameter
};

// Where a packing stands: a box (in two dimensions a die), or a cylinder along z.
struct ContainerSpec {
  enum class Kind { box, cylinder } kind = Kind::box;
  Vec3 corner = Vec3::Zero();   // m, with the smallest x, y, z; centre of the floor of a cylinder
  double width = 0, depth = 0;  // m, along x, y: of a box
  double diameter = 0;          // m, of a cylinder
};

// Square, hexagonal in two dimensions: rows of particles from the bottom. Hexagonal: rows are sqrt(3)/2 of the spacing
// apart, and every second one, shifted by half of it, has one particle less: between flat walls it is symmetric, its full
// rows touch both walls, and the other rows leave a gap of half a particle at each. Lattices in three fill `cells` of
// `spacing`. Random: a mixture in a container, for which two of count, density and height are given. CSV: positions from a
// file.
struct PackingSpec {
  enum class Kind { square, cubic, body_centred, face_centred, hexagonal, random, csv };
  enum class Dense { given, touching, densest };
  Kind kind = Kind::square;
  int particle = 0;
  std::array<int, 3> cells{1, 1, 0};  // along x, y, z; in two dimensions columns, rows, 0
  double spacing =
      0;  // m, centre to centre; in three dimensions, except hexagonal: edge of the cell
  double perturbation = 0;  // -, of the spacing: maximum offset of a centre from its lattice site
  ContainerSpec container;  // of lattices: only the corner of the first cell
  std::optional<double> height;   // m
  std::optional<int> count;       // if the classes give fractions
  std::optional<double> density;  // -
  Dense dense = Dense::given;     // otherwise replaces a density
  std::string file;               // relative to the scene's folder
  std::vector<MixtureClass> classes;
  SourceMark mark;
  // For random and CSV packings, set once the scene has been read:
  std::vector<BodySpec> placed = {};
  double top = 0;  // m, where a punch rests on the packing
  PackingReached reached = {};
};

// Rigid. A plane fills what lies behind `point` and faces along `normal`. In two dimensions a polyline lies to the right of
// its points, a profile below its relief; a constraint touches nothing and holds the nodes of one body that lie in a box or
// within a radius of `point`. In three a die is the inside of a round hole along `normal`; a punch is a body of revolution
// about its normal through `point`; an STL tool is a closed surface with outward normals that moves as a whole.
struct ToolSpec {
  enum class Shape { plane, polyline, constraint, profile, die, punch, stl };
  enum class Holds { x, y, both, radial, z, all };
  std::string name;
  Vec3 point = Vec3::Zero();  // m; for a radial constraint, and one with a radius: its centre
  bool on_packing = false;    // point's last component is the top of the highest packing
  Vec3 normal =
      Vec3::UnitY();  // unit vector, from the tool into the powder; of dies and punches: the axis
  SourceMark mark;
  Shape shape = Shape::plane;
  std::vector<Vec2> points = {};  // m, of a polyline, or of a profile generated from `relief`
  std::string file = {};    // of a drawing, a measured profile, an STL tool: relative to the scene
  std::string unit = {};    // of its numbers, if it gives none
  std::string layer = {};   // of a drawing: the layer to use
  ProfileSpec relief = {};  // of a profile whose crests are at the height of `point`
  double rounding = 0;  // m, radius of a polyline's convex corners, of the edge of a die's mouth
  int body = 0;         // of a constraint, in the order of placement
  Vec3 low = Vec3::Zero();  // m, corners of a constraint's box
  Vec3 high = Vec3::Zero();
  std::optional<double> radius = {};  // m, about `point`, instead of the box
  Holds holds = Holds::both;
  double diameter = 0;  // m, of a die, of a punch
  std::optional<double> height =
      {};  // m, of a die whose hole ends: its mouth, from `point` along the normal
  std::vector<Vec2> profile =
      {};  // m, of a punch: radius, height along the normal; from the axis outward
  // m, relative to `point`, of an STL tool, set once it has been read.
  std::vector<std::array<Vec3, 3>> triangles = {};
};

// Its normal gives the side of the powder.
inline bool has_face(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::plane || tool.shape == ToolSpec::Shape::punch;
}
inline constexpr EnumTable<ToolSpec::Shape> tool_shape_names{
    "plane", "polyline", "constraint", "profile", "die", "punch", "stl"};

struct MoveSpec {
  int tool = 0;                      // index in Scene::tools
  Vec3 displacement = Vec3::Zero();  // m, over the stage
  double ramp = 0.1;  // -, fraction of the stage in which the speed rises smoothly, and falls again
  std::optional<double> stiffness, mass;  // N/m, kg: of a compliant drive, moved at its far end
  double damping = 0;                     // -, fraction of the critical damping of both
  SourceMark mark;
};

struct ServoSpec {                // a tool under force control during one stage
  int tool = 0;                   // index in Scene::tools
  std::optional<Vec3> direction;  // unit vector along which it pushes; absent: the tool's normal
  double force = 0;               // N
  double rise = 0.2;              // -, fraction of the stage until the full force is prescribed
  std::optional<double> rate;     // N/s, instead of `rise`
  double response = 0.1;          // -, mass of the servo relative to that of the powder
  double max_speed = 10;          // m/s
  double tolerance = 0.05;        // -, of the force, at the end of the stage
  SourceMark mark;
};

// Ends a stage before its time is over: exactly one of the three is given.
struct UntilSpec {
  std::optional<int> tool;
  std::optional<double> force, displacement, relative_density;  // N, m, -
  SourceMark mark;
};

struct StageSpec {
  std::string name;
  enum class Kind { settle, compact, hold, unload, eject, shear } kind = Kind::hold;
  double duration = 0;  // s, the maximum if there is an `until`
  std::vector<MoveSpec> moves;
  std::vector<ServoSpec> servos;
  std::optional<UntilSpec> until;
  std::optional<CellDriveSpec> cell;
  bool keep_state = false;  // at its end, as an initial state for other runs
  SourceMark mark;
};

struct FrictionSpec : FrictionParameters {  // of one pair of names (materials or tools)
  std::string first, second;
  SourceMark mark;
};

struct BondSpec {  // for one pair of names (materials or tools)
  enum class Origin { initial, pressed, adhesion } origin = Origin::initial;
  std::string first, second;
  std::optional<double> strength, shear_strength;                // Pa
  std::optional<double> fracture_energy, shear_fracture_energy;  // J/m^2
  double mixed_mode_exponent = 2;                                // -
  double stiffness = 20;                  // -, relative to the contact spring's
  double reach = 0.01;                    // -, relative to the boundary edge
  std::optional<double> weibull_modulus;  // -
  double threshold = 0;                   // Pa
  double growth = 0;                      // -
  double work = 0;                        // J/m^2, of adhesion
  double range = 0;                       // m
  bool inside = false;                    // only between grains of one particle
  SourceMark mark;
};

struct ContactSpec {
  double friction = 0;  // -, Coulomb coefficient of every pair that no [[friction]] names
  // -, k of kappa = k K L/A (bulk modulus, boundary edge length, element area); in three dimensions k K A/V. What a scene
  // does not give, scenes/checks/contact_defaults.cpp does.
  double stiffness = 0.5;
  std::optional<double> tangential_stiffness;  // -, of the springs of friction; none: the same
  std::optional<double> hardness;  // -, over the flow stress; none: surfaces do not indent
  double inertance = 0;            // -, c of systems/body/inerter_kernel.hpp
  double damping = 0;  // -, fraction of the critical damping of the contact spring (T 5.1, 5.2)
  // -, fraction of the shortest edge by which surfaces may approach before the contact list is
  // rebuilt. A rebuild costs about two steps every few hundred; rows not in contact cost memory.
  double skin = 0.2;
};

struct TimeSpec {
  enum class Estimate { element, highest_mode };
  double safety = 0.9;  // -, fraction of the stable time step that is used, in (0, 1)
  Estimate estimate = Estimate::element;
};

struct ElementSpec {
  // four_point: 2x2 points of a quad or 2x2x2 of a hexahedron with a single dilatation.
  Formulation formulation = Formulation::one_point;
};

struct AfmScene;  // scenes/spec/afm_scene.hpp

struct Scene {
  int dimension = 2;
  std::filesystem::path file;
  std::vector<std::filesystem::path> extended;  // by `file`, and by one another in this order
  std::string title;
  double thickness = 1e-3;  // m, of the plane-strain slice: forces are in N
  std::uint64_t seed = 1;
  std::optional<std::string> initial_state;  // file
  std::vector<MaterialSpec> materials;
  std::vector<ParticleSpec> particles;
  std::vector<ParticleSpec> grains;     // for particles that consist of grains
  std::vector<BodySpec> bodies;         // [[body]]
  std::vector<PackingSpec> packings;    // [[packing]]
  std::optional<CellSpec> cell;         // [cell]
  std::vector<ToolSpec> tools;          // [[tool]]
  std::vector<StageSpec> stages;        // [[stage]]
  std::vector<FrictionSpec> frictions;  // [[friction]]
  std::vector<BondSpec> bonds;          // [[bond]]
  ContactSpec contact;
  ElementSpec element;
  TimeSpec time;
  OutputSpec output;
  LimitSpec limits;
  std::vector<ExpectSpec> expects;  // [[expect]]
  // family = "afm": there are then no particles, tools or stages. Not modified after reading.
  std::shared_ptr<AfmScene> afm;

  // Stresses of the particles, hence of the powder: force chains need them, and a periodic cell is evaluated with them.
  bool observes_stress() const {
    return output.particle_stress || output.contacts || cell.has_value();
  }
  bool in_space() const { return dimension == 3; }
  // For a particle or a grain: grain classes are numbered after the particle classes.
  const ParticleSpec& class_of(const BodySpec& body) const {
    const auto number = static_cast<std::size_t>(body.particle);
    return number < particles.size() ? particles[number] : grains.at(number - particles.size());
  }
  const std::filesystem::path& file_of(const SourceMark& mark) const {
    return mark.file == 0 ? file : extended.at(static_cast<std::size_t>(mark.file - 1));
  }
};

}  // namespace pulvis

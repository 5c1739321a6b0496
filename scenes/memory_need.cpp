#include "scenes/memory_need.hpp"

#include <fmt/format.h>

#include <vector>

#include "components/body.hpp"
#include "components/bond.hpp"
#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/highest_mode.hpp"
#include "components/inertance.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "components/space/formulation.hpp"
#include "engine/chunk_lane.hpp"
#include "engine/files/output_error.hpp"
#include "engine/machine_memory.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/needs.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

constexpr std::uint64_t program_bytes = 64U << 20U;

template <class... C>
constexpr std::uint64_t bytes_of() {
  return (0 + ... + (sizeof(typename C::value_type) * C::count));
}

template <class C>
constexpr std::uint64_t bytes_if(bool needed) {
  return needed ? bytes_of<C>() : 0;
}

// What a scene stores, and what a mesh has.
struct Bytes {
  std::uint64_t node = 0, element = 0;
  std::uint64_t boundary_node = 0, control_point = 0;  // of contacts
  double side = 0;  // of rows of contacts, for each boundary edge or face
  std::uint64_t frame_node = 0, frame_element = 0;  // of results
  std::uint64_t density_cell = 0;
};
struct Mesh {
  std::uint64_t nodes = 0, elements = 0, boundary_nodes = 0, sides = 0, control_points = 0;
};

template <class D>
std::uint64_t node_bytes(const Needs& needs) {
  return bytes_of<Position<D>, Velocity<D>, InternalForce<D>>() +
         bytes_if<DampingForce<D>>(needs.bulk_damping);
}

// ---- two dimensions ----------------------------------------------------------------------------------
template <class F>
std::uint64_t quad_bytes(const Needs& needs) {
  std::uint64_t bytes = bytes_of<DeviatoricStress<TwoD, F::points>, MeanStress<F::volumes>>();
  if (F::stabilised) bytes += bytes_of<HourglassStress>();
  if (needs.plastic)
    bytes +=
        bytes_of<IsochoricScale<F::points>, CpInverse<TwoD, F::points>, PlasticStrain<F::points>>();
  if (needs.plastic && F::stabilised) bytes += bytes_of<PlasticHourglass<TwoD>>();
  return bytes;
}

std::uint64_t edge_row_bytes(const Needs& needs) {
  using At = Contact;
  std::uint64_t bytes = bytes_of<ContactPair<At>, ContactTouches<At>, ReactivationDistance<At>,
                                 ContactLaw<At>, PointForce<At>, ContactPlace, ClosestPoint>();
  bytes += bytes_if<ElasticSlip<At>>(needs.friction);
  bytes += bytes_if<SlopeLoad>(needs.friction || needs.bonds());
  bytes += bytes_if<SlipWeakening<At>>(needs.weakening);
  bytes += bytes_if<PointIndentation<At>>(needs.indentation);
  bytes += bytes_if<SurfaceLawNumber<At>>(needs.weakening || needs.adhesion);
  if (needs.bonds())
    bytes += bytes_of<BondLawNumber<At>, BondedPoints<At>, BondOffset<At>, BondStrength<At>,
                      BondDamage<At>, CurveAnchor>();
  bytes += bytes_if<WeldPressure<At>>(needs.welds);
  bytes += bytes_if<ContactImage<At>>(needs.cell);
  return bytes;
}

Bytes bytes_in_plane(const Scene& scene, const Needs& needs) {
  // For a compacted powder: rows for everything closer than the skin, from both sides.
  constexpr double rows_of_an_edge = 3;
  // Of a frame: gathered, being written to the file, in the journal.
  constexpr std::uint64_t copies = 3;
  const bool mode = scene.time.estimate == TimeSpec::Estimate::highest_mode;
  Bytes bytes;
  bytes.node = node_bytes<TwoD>(needs) + bytes_if<HighestMode<TwoD>>(mode) +
               bytes_if<Inertance>(needs.inerters);
  bytes.element =
      with_formulation(needs.formulation, [&]<class F>(F) { return quad_bytes<F>(needs); });
  bytes.boundary_node = bytes_of<ContactForce<TwoD>>() + bytes_if<ContactSupport>(mode);
  bytes.control_point = bytes_of<CurvePosition, CurveBefore, CurveForce>() +
                        bytes_if<CurveVelocity>(needs.friction || needs.damping) +
                        bytes_if<SurfaceHardness<TwoD>>(needs.indentation);
  bytes.side = rows_of_an_edge * static_cast<double>(edge_row_bytes(needs));
  bytes.frame_node = copies * 5 * sizeof(double);
  bytes.frame_element = copies * 7 * sizeof(double);
  // Areas of particles and tools during summation, stored areas, and a frame's copies: 90 were measured.
  bytes.density_cell = 120;
  return bytes;
}

Mesh quad_mesh(const ParticleSpec& particle) {
  const Shape shape = make_shape(particle);
  const auto edges = static_cast<std::uint64_t>(shape.boundary_nodes);
  return {shape.nodes.size(), shape.quads.size(), edges, edges,
          static_cast<std::uint64_t>(shape.control_points())};
}

// ---- three dimensions --------------------------------------------------------------------------------
template <class F>
std::uint64_t hexahedron_bytes(const Needs& needs) {
  std::uint64_t bytes = bytes_of<DeviatoricStress<ThreeD, F::points>, MeanStress<1>>();
  if (needs.plastic) bytes += bytes_of<CpInverse<ThreeD, F::points>, PlasticStrain<F::points>>();
  if (needs.plastic && F::stabilised) bytes += bytes_of<PlasticHourglass<ThreeD>>();
  return bytes;
}

std::uint64_t face_row_bytes(const Scene& scene, const Needs& needs) {
  using At = FaceContact;
  std::uint64_t bytes =
      bytes_of<ContactPair<At>, ContactTouches<At>, space::ReactivationDistance<At>,
               space::RowTravel, ContactLaw<At>, space::ContactPoint>() +
      sizeof(space::PairLoads::Load);
  bytes += bytes_if<SlipWeakening<At>>(needs.weakening);
  bytes += bytes_if<PointIndentation<At>>(needs.indentation);
  bytes += bytes_if<space::ContactPointForce>(scene.output.contacts);
  if (needs.bonds()) bytes += bytes_of<space::BondedPoints<At>, BondDamage<At>, BondStrength<At>>();
  bytes += bytes_if<space::BondOffset<At>>(needs.initial_bonds);
  bytes += bytes_if<space::WeldPressure<At>>(needs.welds);
  bytes += bytes_if<ContactImage<At>>(needs.cell);
  return bytes;
}

Bytes bytes_in_space(const Scene& scene, const Needs& needs) {
  constexpr double rows_of_a_face = 2;
  // Of a frame: gathered; and for its largest fields, the data packed for the file and the journal.
  constexpr std::uint64_t copies = 2;
  Bytes bytes;
  const bool mode = scene.time.estimate == TimeSpec::Estimate::highest_mode;
  bytes.node = node_bytes<ThreeD>(needs) + bytes_if<HighestMode<ThreeD>>(mode) +
               bytes_if<Inertance>(needs.inerters);
  bytes.element = space::with_hexahedra(needs.formulation,
                                        [&]<class F>(F) { return hexahedron_bytes<F>(needs); });
  // Of as many faces as nodes, but for two.
  bytes.boundary_node = bytes_of<ContactForce<ThreeD>>() + bytes_if<ContactSupport>(mode) +
                        bytes_if<SurfaceHardness<ThreeD>>(needs.indentation);
  bytes.control_point = bytes_of<space::SurfacePosition, space::SurfaceBefore>() +
                        bytes_if<space::SurfaceVelocity>(needs.friction || needs.damping);
  bytes.side = rows_of_a_face * static_cast<double>(face_row_bytes(scene, needs));
  bytes.frame_node = copies * 6 * sizeof(double);
  bytes.frame_element = copies * 9 * sizeof(double);
  // Volumes of particles during summation, stored volumes, the room, and a frame's copies.
  bytes.density_cell = 100;
  return bytes;
}

Mesh hexahedron_mesh(const HexMeshSpec& mesh) {
  const auto size = [](std::int64_t count) { return static_cast<std::uint64_t>(count); };
  return {size(mesh.nodes()), size(mesh.hexahedra()), size(mesh.surface_nodes()),
          size(mesh.faces()), size(mesh.surface_points())};
}

// ---- the same for both -------------------------------------------------------------------------------
std::vector<std::uint64_t> particles_of_classes(const Scene& scene) {
  std::vector<std::uint64_t> count(scene.particles.size() + scene.grains.size());
  for (const BodySpec& body : grains_of(scene, place_bodies(scene)))
    count[static_cast<std::size_t>(body.particle)] += 1;
  return count;
}

std::uint64_t density_cells(const Scene& scene) {
  std::uint64_t cells = 1;
  const auto times = [&](int count) { cells *= static_cast<std::uint64_t>(count); };
  if (scene.in_space())
    for (const int count : scene.output.density_cells3) times(count);
  else
    for (const int count : scene.output.density_cells) times(count);
  return cells;
}

void add_class(const Mesh& mesh, const Bytes& bytes, std::uint64_t particles, bool contact,
               MemoryNeed& need) {
  const std::uint64_t lanes = (particles + lane_count - 1) / lane_count * lane_count;
  need.columns += lanes * (mesh.nodes * bytes.node + mesh.elements * bytes.element);
  need.results += particles * (mesh.nodes * bytes.frame_node + mesh.elements * bytes.frame_element);
  if (!contact) return;
  need.columns += lanes * (mesh.boundary_nodes * bytes.boundary_node +
                           mesh.control_points * bytes.control_point);
  need.contacts +=
      static_cast<std::uint64_t>(static_cast<double>(particles * mesh.sides) * bytes.side);
}

// Of so many ranks.
MemoryNeed of_ranks(MemoryNeed need, int count, int all) {
  const auto some = static_cast<std::uint64_t>(count);
  need.columns = need.columns * some / static_cast<std::uint64_t>(all);
  need.contacts = need.contacts * some / static_cast<std::uint64_t>(all);
  need.program *= some;
  return need;
}

}  // namespace

MemoryNeed memory_need(const Scene& scene) {
  const std::vector<std::uint64_t> particles = particles_of_classes(scene);
  std::uint64_t all = 0;
  for (const std::uint64_t count : particles) all += count;
  const Needs needs = needs_of(scene, all);
  const Bytes bytes =
      scene.in_space() ? bytes_in_space(scene, needs) : bytes_in_plane(scene, needs);
  MemoryNeed need;
  need.program = program_bytes;
  need.results = bytes.density_cell * density_cells(scene);
  for (std::size_t c = 0; c < particles.size(); ++c) {
    if (particles[c] == 0) continue;
    const bool whole = c < scene.particles.size();
    const ParticleSpec& particle =
        whole ? scene.particles[c] : scene.grains[c - scene.particles.size()];
    const Mesh mesh = scene.in_space() ? hexahedron_mesh(particle.hex_mesh) : quad_mesh(particle);
    add_class(mesh, bytes, particles[c], needs.contact(), need);
  }
  return need;
}

MemoryNeed require_memory(const Scene& scene, const std::vector<MachineMemory>& machines) {
  const MemoryNeed need = memory_need(scene);
  int all = 0;
  for (const MachineMemory& machine : machines) all += machine.ranks;
  MemoryNeed of_all = need;
  const auto require = [&](const MachineMemory& machine, int count, std::uint64_t left) {
    const std::uint64_t needed = of_ranks(of_all, count, all).total();
    if (needed <= left) return;
    const std::string where = machine.name.empty() ? ""
                                                   : fmt::format(" on {} for {} of its {} ranks",
                                                                 machine.name, count, all);
    throw OutputError(scene.file, "run it",
                      fmt::format("it needs about {} of memory{}, but only {} are available",
                                  bytes_text(needed), where, bytes_text(left)));
  };
  for (const MachineMemory& machine : machines) {
    require(machine, machine.ranks, machine.left);
    require(machine, 1, machine.left_to_each);
    of_all.results = 0;  // on the first machine only
  }
  return need;
}

}  // namespace pulvis

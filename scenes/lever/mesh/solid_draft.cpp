#include "scenes/lever/mesh/solid_draft.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <tuple>

#include "systems/laws/flow_law.hpp"
#include "systems/lever/static_solver.hpp"

namespace pulvis {
namespace {

constexpr int elements_of_chunk = 16;  // about a millisecond of work

// Resolves a node's supports down to free nodes; held ones drop out.
void trace(const SolidDraft& draft, const SolidMesh::Support& support,
           std::map<std::int32_t, double>& supports) {
  const auto node = static_cast<std::size_t>(support.node);
  if (draft.held[node] != 0) return;
  if (draft.hanging[node].empty()) supports[support.node] += support.weight;
  for (const auto& next : draft.hanging[node])
    trace(draft, {next.node, support.weight * next.weight}, supports);
}

// Equal numbers of chunks for both element types, since there is only one chunk count.
void divide(SolidMesh& mesh) {
  const auto hexahedra = static_cast<std::int32_t>(mesh.hexahedra.size());
  const auto tetrahedra = static_cast<std::int32_t>(mesh.tetrahedra.size());
  for (std::int32_t e = 0; e < std::max(hexahedra, tetrahedra); e += elements_of_chunk) {
    mesh.chunk_begin.push_back(std::min(e, hexahedra));
    mesh.tetrahedron_begin.push_back(std::min(e, tetrahedra));
  }
  mesh.chunk_begin.push_back(hexahedra);
  mesh.tetrahedron_begin.push_back(tetrahedra);
}

std::vector<std::int32_t> rows_of(const std::vector<std::int32_t>& begin) {
  std::vector<std::int32_t> rows;
  for (std::size_t c = 0; c + 1 < begin.size(); ++c) rows.push_back(begin[c + 1] - begin[c]);
  return rows;
}

// Calls `each(element, its nodes, whether it is a tetrahedron)`.
template <class Each>
void for_elements(const SolidMesh& mesh, const Each& each) {
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
    each(static_cast<std::int32_t>(e), mesh.hexahedra[e], false);
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
    each(static_cast<std::int32_t>(e), mesh.tetrahedra[e], true);
}

SolidMesh mesh_of(const SolidDraft& draft) {
  SolidMesh mesh;
  mesh.hexahedra = draft.hexahedra;
  mesh.formulation = draft.formulation;
  mesh.part = draft.part;
  mesh.support_begin.push_back(0);
  for (std::size_t n = 0; n < draft.nodes.size(); ++n) {
    const bool free = draft.held[n] == 0 && draft.hanging[n].empty();
    mesh.unknown.push_back(free ? mesh.unknowns++ : -1);
    if (free) mesh.supports.push_back({static_cast<std::int32_t>(n), 1.0});
    std::map<std::int32_t, double> supports;
    for (const auto& support : draft.hanging[n]) trace(draft, support, supports);
    for (const auto& [node, weight] : supports) mesh.supports.push_back({node, weight});
    mesh.support_begin.push_back(static_cast<std::int32_t>(mesh.supports.size()));
  }
  mesh.tetrahedra = draft.tetrahedra;
  mesh.tetrahedron_part = draft.tetrahedron_part;
  divide(mesh);
  return mesh;
}

void list_forces(const SolidMesh& mesh, std::size_t nodes, SolidAssembly& assembly) {
  std::vector<std::vector<SolidAssembly::Share>> of_node(nodes);
  for_elements(mesh, [&](std::int32_t element, const auto& of_element, bool tetrahedron) {
    for (std::size_t a = 0; a < of_element.size(); ++a)
      of_node[static_cast<std::size_t>(of_element[a])].push_back(
          {element, static_cast<std::int8_t>(a), 0, tetrahedron, 1.0});
  });
  assembly.force_begin.push_back(0);
  for (const auto& shares : of_node) {
    assembly.forces.insert(assembly.forces.end(), shares.begin(), shares.end());
    assembly.force_begin.push_back(static_cast<std::int32_t>(assembly.forces.size()));
  }
}

struct PlacedShare {
  std::int32_t column, row;
  SolidAssembly::Share share;
};

std::vector<PlacedShare> placed_shares(const SolidMesh& mesh) {
  std::vector<PlacedShare> placed;
  for_elements(mesh, [&](std::int32_t element, const auto& nodes, bool tetrahedron) {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (const auto& r : mesh.supports_of(nodes[a]))
          for (const auto& c : mesh.supports_of(nodes[b])) {
            const std::int32_t row = mesh.unknown[static_cast<std::size_t>(r.node)];
            const std::int32_t column = mesh.unknown[static_cast<std::size_t>(c.node)];
            if (row >= column)
              placed.push_back({column,
                                row,
                                {element, static_cast<std::int8_t>(a), static_cast<std::int8_t>(b),
                                 tetrahedron, r.weight * c.weight}});
          }
  });
  std::ranges::stable_sort(placed, {}, [](const PlacedShare& p) {
    return std::pair{p.column, p.row};
  });
  return placed;
}

void list_blocks(const SolidMesh& mesh, SolidAssembly& assembly) {
  std::pair<std::int32_t, std::int32_t> last{-1, -1};
  for (const PlacedShare& placed : placed_shares(mesh)) {
    if (std::pair{placed.column, placed.row} != last) {
      while (static_cast<std::int32_t>(assembly.column_begin.size()) <= placed.column)
        assembly.column_begin.push_back(static_cast<std::int32_t>(assembly.block_row.size()));
      assembly.block_row.push_back(placed.row);
      assembly.block_begin.push_back(static_cast<std::int32_t>(assembly.shares.size()));
      last = {placed.column, placed.row};
    }
    assembly.shares.push_back(placed.share);
  }
  assembly.column_begin.push_back(static_cast<std::int32_t>(assembly.block_row.size()));
  assembly.block_begin.push_back(static_cast<std::int32_t>(assembly.shares.size()));
}

void fill_columns(const SolidDraft& draft, const std::array<SolidMaterial, 4>& materials,
                  World& world) {
  double* x = world.column<ReferencePosition>().values();
  for (const Vec3& node : draft.nodes)
    for (int k = 0; k < 3; ++k) *x++ = node[k];
  const auto fill_lame = [&](double* elastic, const std::vector<std::uint8_t>& parts) {
    for (const std::uint8_t part : parts) {
      *elastic++ = materials[part].lambda;
      *elastic++ = materials[part].mu;
    }
  };
  fill_lame(world.column<LameConstants>().values(), draft.part);
  if (world.has<TetrahedronLame>())
    fill_lame(world.column<TetrahedronLame>().values(), draft.tetrahedron_part);
  if (!world.has<SolidYield>()) return;
  double* yield = world.column<SolidYield>().values();
  for (const std::uint8_t part : draft.part) {
    *yield++ = materials[part].yield_stress;
    *yield++ = materials[part].hardening_modulus;
  }
}

}  // namespace

int SolidDraft::add_node(const Vec3& x) {
  nodes.push_back(x);
  held.push_back(0);
  hanging.emplace_back();
  return static_cast<int>(nodes.size()) - 1;
}

void SolidDraft::hang(int node, std::vector<SolidMesh::Support> on) {
  if (held[static_cast<std::size_t>(node)] == 0)
    hanging[static_cast<std::size_t>(node)] = std::move(on);
}

void SolidDraft::add_hexahedron(const SolidMesh::Hexahedron& corners, SolidPart of,
                                HexFormulation how) {
  hexahedra.push_back(corners);
  part.push_back(static_cast<std::uint8_t>(of));
  formulation.push_back(how);
}

void SolidDraft::add_tetrahedron(const SolidMesh::Tetrahedron& of_nodes, SolidPart of) {
  tetrahedra.push_back(of_nodes);
  tetrahedron_part.push_back(static_cast<std::uint8_t>(of));
}

bool turn_outside_out(const std::vector<Vec3>& nodes, SolidMesh::Hexahedron& corners) {
  const auto x = [&](std::size_t c) { return nodes[static_cast<std::size_t>(corners[c])]; };
  const Vec3 a = x(1) - x(0), b = x(3) - x(0), c = x(4) - x(0);
  if (a.cross(b).dot(c) < 0) {
    std::swap(corners[1], corners[3]);
    std::swap(corners[5], corners[7]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4, last = (i + 3) % 4;
    const double below = (x(next) - x(i)).cross(x(last) - x(i)).dot(x(i + 4) - x(i));
    const double above =
        (x(next + 4) - x(i + 4)).cross(x(last + 4) - x(i + 4)).dot(x(i + 4) - x(i));
    if (!(below > 0 && above > 0)) return false;
  }
  return true;
}

SolidMaterial solid_material(const MaterialSpec& m) {
  const double nu = m.poissons_ratio;
  return {m.youngs_modulus * nu / ((1 + nu) * (1 - 2 * nu)), m.youngs_modulus / (2 * (1 + nu)),
          m.yield_stress.value_or(0), m.hardening_modulus, m.flow};
}

std::unique_ptr<World> finish_solid(const SolidDraft& draft,
                                    const std::array<SolidMaterial, 4>& materials) {
  auto world = std::make_unique<World>();
  const auto& mesh = world->emplace<SolidMesh>(mesh_of(draft));
  auto& assembly = world->emplace<SolidAssembly>();
  list_forces(mesh, draft.nodes.size(), assembly);
  list_blocks(mesh, assembly);
  world->add_table<SolidNode>(draft.nodes.size());
  world->add_table<SolidElement>(rows_of(mesh.chunk_begin));
  world->add_table<StiffnessBlock>(assembly.block_row.size());
  world->add<ReferencePosition>();
  world->add<LameConstants>();
  if (!mesh.tetrahedra.empty()) {
    world->add_table<SolidTetrahedron>(rows_of(mesh.tetrahedron_begin));
    add_tetrahedron_columns(*world);
  }
  add_solid_columns(*world);
  if (std::ranges::any_of(draft.part,
                          [&](std::uint8_t part) { return materials[part].yield_stress > 0; }))
    add_plastic_columns(*world);
  if (std::ranges::any_of(materials, [](const SolidMaterial& m) { return m.flow != nullptr; }))
    for (FlowLaws& laws = world->emplace<FlowLaws>(); const SolidMaterial& m : materials)
      laws.of_material.push_back(m.flow ? *m.flow : FlowLaw{});
  fill_columns(draft, materials, *world);
  return world;
}

}  // namespace pulvis

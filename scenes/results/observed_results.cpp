// Series and fields observed in addition to forces and energies; see scenes/results/observe.hpp.
#include "scenes/results/observed_results.hpp"

#include <cmath>
#include <limits>

#include "components/run_state.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/results/parts/network_results.hpp"
#include "scenes/results/results.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

using Fields = std::vector<std::vector<double>>;

// First value of the particle in a slot, in a particle column.
template <class C>
const double* in_slot(const World& world, int slot) {
  const Lane* row = world.column<C>().lanes() + std::ptrdiff_t{slot / lane_count} * C::count;
  return reinterpret_cast<const double*>(row) +
         slot % lane_count;  // the next one is lane_count further
}

template <class C>
std::vector<double> by_number(const World& world) {
  std::vector<double> all;
  for (const int slot : world.resource<Bodies>().slot_of_number)
    for (int k = 0; k < C::count; ++k) all.push_back(in_slot<C>(world, slot)[k * lane_count]);
  return all;
}

// ---- stress -----------------------------------------------------------------------------------------
void append_compact_stress(const World& world, double area, std::vector<double>& row) {
  std::array<double, 4> s{};
  for (const int slot : world.resource<Bodies>().slot_of_number)
    for (std::size_t k = 0; k < 4; ++k)
      s[k] += in_slot<DeformedSize<TwoD>>(world, slot)[0] / area *
              in_slot<ParticleStress<TwoD>>(world, slot)[k * lane_count];
  const double mean = (s[0] + s[1] + s[2]) / 3;
  const double xx = s[0] - mean, yy = s[1] - mean, zz = s[2] - mean;
  const double deviatoric = std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * s[3] * s[3]));
  row.insert(row.end(), {s[0], s[1], s[3], mean, s[2], deviatoric});
}

// ---- contacts -----------------------------------------------------------------------------------------
constexpr LinkWords link_words{2, "along the normal rotated by 90 degrees", "length", "m",
                               "of the surface in contact; times thickness: area"};

ContactCounts contact_counts(const World& world) {
  return {world.resource<ContactNetwork<TwoD>>(), world.resource<Bodies>().particles()};
}

void append_network(const World& world, std::vector<double>& row) {
  const auto& network = world.resource<ContactNetwork<TwoD>>();
  const auto particles = static_cast<double>(world.resource<Bodies>().particles());
  const kernels::Fabric fabric = kernels::fabric(network.pairs);
  const kernels::ForceSizes sizes = kernels::force_sizes(network.pairs);
  row.insert(row.end(), {2 * static_cast<double>(network.pairs.size()) / particles,
                         static_cast<double>(network.tools.size()) / particles,
                         contact_counts(world).rattlers(), fabric.xx, fabric.xy, fabric.yy,
                         fabric.anisotropy(), fabric.angle(), sizes.mean, sizes.maximum,
                         share_in_chains(world.resource<ForceChains>().chain)});
}

void append_network_frame(const World& world, Fields& fields) {
  const auto& network = world.resource<ContactNetwork<TwoD>>();
  append_links(network.pairs, fields);
  append_links(network.tools, fields);
  const kernels::Rose rose = kernels::rose(network.pairs);
  fields.emplace_back(rose.number.begin(), rose.number.end());
  fields.emplace_back(rose.force.begin(), rose.force.end());
  append_counts(contact_counts(world), world.resource<ForceChains>().chain, fields);
}

// ---- density ------------------------------------------------------------------------------------------
// A cell filled by a tool except for round-off has no density.
double density_of(double filled, double room, double cell) {
  return room > 1e-9 * cell ? filled / room : std::numeric_limits<double>::quiet_NaN();
}

struct GridView {
  const DensityGrid& grid;
  double width = (grid.side[1] - grid.side[0]) / grid.columns;
  double height = (grid.side[3] - grid.side[2]) / grid.rows;

  std::vector<double> cells() const {
    std::vector<double> density;
    for (std::size_t c = 0; c < grid.filled.size(); ++c)
      density.push_back(density_of(grid.filled[c], grid.room[c], width * height));
    return density;
  }
  std::vector<double> profile() const {
    std::vector<double> density;
    for (int j = 0; j < grid.rows; ++j) {
      double filled = 0, room = 0;
      for (int i = 0; i < grid.columns; ++i) {
        const auto c = static_cast<std::size_t>(j * grid.columns + i);
        filled += grid.filled[c];
        room += grid.room[c];
      }
      density.push_back(density_of(filled, room, width * height));
    }
    return density;
  }
  std::vector<double> lines(int first_side, int cells, double size) const {
    std::vector<double> at;
    for (int i = 0; i <= cells; ++i)
      at.push_back(grid.side[static_cast<std::size_t>(first_side)] + i * size);
    return at;
  }
};

void append_density(const World& world, std::vector<double>& row) {
  const auto& grid = world.resource<DensityGrid>();
  const std::vector<double> cells = GridView{grid}.cells();
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double filled = 0, room = 0, minimum = unknown, maximum = unknown, squares = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    filled += grid.filled[c];
    room += grid.room[c];
    if (std::isnan(cells[c])) continue;
    minimum = std::fmin(minimum, cells[c]);  // ignores the argument that is NaN
    maximum = std::fmax(maximum, cells[c]);
  }
  const double mean = filled / room;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (!std::isnan(cells[c])) squares += grid.room[c] * (cells[c] - mean) * (cells[c] - mean);
  row.insert(row.end(), {mean, minimum, maximum, std::sqrt(squares / room)});
}

void append_density_frame(const World& world, Fields& fields) {
  const GridView view{world.resource<DensityGrid>()};
  fields.push_back(view.cells());
  fields.push_back(view.profile());
  fields.push_back(view.lines(DensityGrid::left, view.grid.columns, view.width));
  fields.push_back(view.lines(DensityGrid::bottom, view.grid.rows, view.height));
}

}  // namespace

std::vector<SeriesInfo> observed_series(const Scene& scene) {
  std::vector<SeriesInfo> all;
  if (scene.observes_stress() && (scene.cell || die_cell(scene)))
    all.insert(
        all.end(),
        {{"stress/xx", "Pa",
          "Cauchy, mean over the area between the tools, or of the cell; tension > 0"},
         {"stress/yy", "Pa", "as stress/xx"},
         {"stress/xy", "Pa", "as stress/xx"},
         {"stress/mean", "Pa", "(xx + yy + zz) / 3 over the same area: minus the pressure p"},
         {"stress/zz", "Pa", "the same, normal to the plane of strain"},
         {"stress/deviatoric", "Pa", "von Mises' stress q of these means"}});
  if (scene.output.contacts)
    all.insert(
        all.end(),
        {{"network/coordination", "-", "mean number of other particles that a particle touches"},
         {"network/tools", "-", "mean number of tools that a particle touches"},
         {"network/rattlers", "-", "share of particles that touch fewer than two others or tools"},
         {"network/fabric_xx", "-", "fabric tensor of the contacts between particles"},
         {"network/fabric_xy", "-", "fabric tensor of the contacts between particles"},
         {"network/fabric_yy", "-", "fabric tensor of the contacts between particles"},
         {"network/anisotropy", "-", "difference of the fabric tensor's principal values"},
         {"network/fabric_angle", "rad", "of the preferred direction of the contacts, from x"},
         {"network/mean_force", "N", "normal, between particles"},
         {"network/largest_force", "N", "normal, between particles"},
         {"network/chain_share", "-", "share of particles in force chains"}});
  if (scene.output.density())
    all.insert(
        all.end(),
        {{"density/compact", "-", "deformed particle area / area between the tools' surfaces"},
         {"density/minimum", "-", "of the cells"},
         {"density/maximum", "-", "of the cells"},
         {"density/deviation", "-", "standard deviation over the cells, by their areas"}});
  return all;
}

std::vector<FieldInfo> observed_fields(const Scene& scene) {
  std::vector<FieldInfo> all;
  const auto append = [&](std::vector<FieldInfo> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (scene.observes_stress())
    append({{"particle_stress", "Pa", ParticleStress<TwoD>::info.meaning, FieldPlace::particle, 4},
            {"particle_centre", "m", ParticleCentre<TwoD>::info.meaning, FieldPlace::particle, 2}});
  if (scene.output.contacts) {
    append(link_fields("contacts", true, link_words));
    append(link_fields("tool_contacts", false, link_words));
    append({{"rose/number", "-",
             "share of the contacts between particles whose normal lies in each of 18 sectors, the "
             "first around the x axis",
             FieldPlace::list, 1},
            {"rose/force", "-", "the same, weighted with the normal force", FieldPlace::list, 1},
            {"coordination", "-", "other particles that it touches", FieldPlace::particle, 1, true},
            {"tools_touched", "-", "tools that it touches", FieldPlace::particle, 1, true},
            {"force_chain", "-", "number of its force chain; 0: none", FieldPlace::particle, 1,
             true}});
  }
  if (scene.output.density())
    append({{"local_density", "-", "of every cell; NaN where a tool fills it; rows from the bottom",
             FieldPlace::list, scene.output.density_cells[0]},
            {"density_profile", "-", "of every row of cells, from the bottom", FieldPlace::list, 1},
            {"density_grid/x", "m", "lines between the columns", FieldPlace::list, 1},
            {"density_grid/y", "m", "lines between the rows", FieldPlace::list, 1}});
  return all;
}

void append_observed_sample(const World& world, double die_area, std::vector<double>& row) {
  if (world.has<ParticleStress<TwoD>>() && die_area > 0)
    append_compact_stress(world, die_area, row);
  if (world.has<ContactNetwork<TwoD>>()) append_network(world, row);
  if (world.has<DensityGrid>()) append_density(world, row);
}

void append_observed_frame(const World& world, Fields& fields) {
  if (world.has<ParticleStress<TwoD>>()) {
    fields.push_back(by_number<ParticleStress<TwoD>>(world));
    fields.push_back(by_number<ParticleCentre<TwoD>>(world));
  }
  if (world.has<ContactNetwork<TwoD>>()) append_network_frame(world, fields);
  if (world.has<DensityGrid>()) append_density_frame(world, fields);
}

}  // namespace pulvis

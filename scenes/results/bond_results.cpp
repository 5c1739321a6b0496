#include "scenes/results/bond_results.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "components/bond.hpp"
#include "components/space/shape.hpp"
#include "scenes/space/results/bonded_faces.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "systems/contact/contact_outlines.hpp"

namespace pulvis {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

bool in_space(const World& world) { return world.has<space::Shapes>(); }

// m^2, or in three dimensions m^3, undeformed.
double size_of_particle(const World& world, int slot) {
  const Bodies& bodies = world.resource<Bodies>();
  if (!in_space(world)) return bodies.shape_of_slot(slot).area;
  return entry(world.resource<space::Shapes>().list, entry(bodies.slots, slot).shape).volume;
}
std::vector<FragmentSize> fragments_of(const World& world) {
  std::vector<double> sizes;
  for (const int slot : world.resource<Bodies>().slot_of_number)
    sizes.push_back(size_of_particle(world, slot));
  return fragment_sizes(world.resource<Fragments>().of_particle, sizes);
}

double largest_share(const std::vector<FragmentSize>& fragments) {
  double all = 0, most = 0;
  for (const FragmentSize& fragment : fragments) {
    all += fragment.size;
    most = std::max(most, fragment.size);
  }
  return most / all;
}

// For one particle, or for all. NaN where nothing was bonded at the start.
double damage(double bonded, double broken) {
  return bonded + broken > 0 ? broken / (bonded + broken) : no_value;
}
double total_damage(const Fragments& found) {
  const auto sum = [](const std::vector<double>& of) {
    return std::accumulate(of.begin(), of.end(), 0.0);
  };
  return damage(sum(found.bonded), sum(found.broken));
}

// Of every particle: the lowest number among the grains of the same particle, so that it can be joined with other numbers.
std::vector<double> parents_of(const Bodies& bodies) {
  std::vector<double> parents;
  std::map<int, int> first;  // by Slot::parent
  for (const int slot : bodies.slot_of_number) {
    const Bodies::Slot& of = entry(bodies.slots, slot);
    parents.push_back(first.try_emplace(of.parent, of.number).first->second);
  }
  return parents;
}

// ---- lines on the outlines --------------------------------------------------------------------------
// The part of its edge that Gauss point g represents, from 0 to 1.
double begin_of_point(int g) {
  double begin = 0;
  for (int i = 0; i < g; ++i) begin += entry(kernels::edge_w, i);
  return begin;
}

struct Lines {
  std::vector<double> start, end;

  void add(const Curve& edge, int first, int last) {
    const Point from = edge.value(begin_of_point(first));
    const Point to = edge.value(begin_of_point(last + 1));
    start.insert(start.end(), from.begin(), from.end());
    end.insert(end.end(), to.begin(), to.end());
  }
};

Outlines outlines_of(const World& world) {
  const Column<CurvePosition>& control = world.column<CurvePosition>();
  return {world.resource<Bodies>(), {control.values(), 2 * control.table.rows}};
}

// A line for every run of neighbouring points of an edge that are bonded to the same body.
struct BondLines {
  std::vector<double> ids, length, damage;
  Lines lines;

  template <class At>
  void add(const World& world) {
    const Outlines outlines = outlines_of(world);
    const std::int32_t* pair = world.column<ContactPair<At>>().values();
    const std::uint8_t* points = world.column<BondedPoints<At>>().values();
    for (std::size_t r = 0; r < world.column<BondedPoints<At>>().table.rows; ++r, pair += 3) {
      const unsigned bonded = points[r];
      for (int g = 0; g < edge_points; ++g) {
        const int first = g;
        while (g < edge_points && (bonded >> g & 1) != 0) ++g;
        if (g == first) continue;
        add_run<At>(world, r, first, g);
        const int other = std::is_same_v<At, Contact> ? outlines.number(pair[2]) : -1 - pair[2];
        ids.insert(ids.end(), {1.0 * outlines.number(pair[0]), 1.0 * other});
        lines.add(outlines.edge(pair[0], pair[1]), first, g - 1);
      }
    }
  }

 private:
  template <class At>
  void add_run(const World& world, std::size_t row, int first, int end) {
    constexpr double share = std::is_same_v<At, Contact> ? 0.5 : 1;
    const double* of_point = world.column<BondDamage<At>>().values() + row * edge_points;
    const double* area = world.column<ContactLaw<At>>().values() + row * ContactLaw<At>::count +
                         ContactLaw<At>::weight;
    double sum = 0, areas = 0;
    for (int g = first; g < end; ++g) {
      sum += area[g] * of_point[g];
      areas += area[g];
    }
    length.push_back(share * areas / world.resource<Bodies>().thickness);
    damage.push_back(sum / areas);
  }
};

// At their current positions.
Lines crack_lines(const World& world) {
  Lines lines;
  const Outlines outlines = outlines_of(world);
  for (const Crack& crack : world.resource<BondTotals>().cracks)
    lines.add(outlines.edge(crack.slot, crack.edge), crack.point, crack.point);
  return lines;
}

constexpr const char* other_meaning =
    "number of the other particle; for a tool: -1 - its position in the scene";
const char* damage_meaning(const Scene& scene) {
  return scene.space ? "broken share of the area bonded at the start; NaN if nothing was bonded"
                     : "broken share of the length bonded at the start; NaN if nothing was bonded";
}

// Where the bonds and cracks are: lines in two dimensions; in three one entry per bonded face, and points of the cracks.
std::vector<FieldInfo> place_fields(const Scene& scene) {
  constexpr auto list = FieldPlace::list;
  const FieldInfo damage{"bonds/damage", "-", "mean of its bonded points, 0 ... 1", list, 1};
  if (scene.space)
    return {
        {"bonds/ids", "-", std::string("number of the particle whose face it is; ") + other_meaning,
         list, 2, true},
        {"bonds/area", "m^2", "as in bonds/area: half of it where the other side is listed as well",
         list, 1},
        damage,
        {"bonds/position", "m", "mean of its bonded points", list, 3},
        {"cracks/position", "m", "of every row of /cracks so far: where its point is now", list,
         3}};
  return {{"bonds/ids", "-",
           std::string("number of the particle whose edge it is; ") + other_meaning, list, 2, true},
          {"bonds/length", "m",
           "as in bonds/area: half of it where the other side has a line as well", list, 1},
          damage,
          {"bonds/start", "m", "of a line along the bonded part of an edge", list, 2},
          {"bonds/end", "m", "of a line along the bonded part of an edge", list, 2},
          {"cracks/start", "m",
           "of every row of /cracks so far: its part of the edge, where it is now", list, 2},
          {"cracks/end", "m",
           "of every row of /cracks so far: its part of the edge, where it is now", list, 2}};
}

void append_places(const World& world, std::vector<std::vector<double>>& fields) {
  if (in_space(world)) return space::append_bonded_faces(world, fields);
  BondLines bonds;
  if (world.has<CurveAnchor>()) bonds.add<Contact>(world);
  if (world.has<ToolAnchor>()) bonds.add<ToolContact>(world);
  Lines cracks;
  if (world.has<CurvePosition>()) cracks = crack_lines(world);
  for (std::vector<double>* list : {&bonds.ids, &bonds.length, &bonds.damage, &bonds.lines.start,
                                    &bonds.lines.end, &cracks.start, &cracks.end})
    fields.push_back(std::move(*list));
}

}  // namespace

// ---- series -------------------------------------------------------------------------------------------
std::vector<SeriesInfo> bond_series(const Scene& scene) {
  if (!has_bonds(scene)) return {};
  std::vector<SeriesInfo> all{{"bonds/area", "m^2", "of the bonded surfaces"}};
  all.push_back(scene.space ? SeriesInfo{"bonds/crack_area", "m^2", "of all cracks so far"}
                            : SeriesInfo{"bonds/crack_length", "m", "of all cracks so far"});
  all.insert(all.end(),
             {{"bonds/damage", "-", damage_meaning(scene)},
              {"bonds/fragments", "-", "pieces held together by bonds, including loose particles"},
              {"bonds/largest_fragment", "-",
               scene.space ? "volume of the largest fragment / volume of the particles"
                           : "area of the largest fragment / area of the particles"}});
  return all;
}

void append_bond_sample(const World& world, std::vector<double>& row) {
  if (!world.has<BondTotals>()) return;
  const BondTotals& bonds = world.resource<BondTotals>();
  const std::vector<FragmentSize> fragments = fragments_of(world);
  row.insert(row.end(), {bonds.area, bonds.crack_size, total_damage(world.resource<Fragments>()),
                         static_cast<double>(fragments.size()), largest_share(fragments)});
}

// ---- frames -------------------------------------------------------------------------------------------
std::vector<FieldInfo> bond_fields(const Scene& scene) {
  if (!has_bonds(scene)) return {};
  constexpr auto list = FieldPlace::list;
  std::vector<FieldInfo> all = place_fields(scene);
  all.insert(all.end(),
             {{"fragments/number", "-", "lowest particle number of each fragment", list, 1, true},
              {"fragments/particles", "-", "number of its particles", list, 1, true}});
  const char* of_particles = "of its particles, undeformed";
  all.push_back(scene.space ? FieldInfo{"fragments/volume", "m^3", of_particles, list, 1}
                            : FieldInfo{"fragments/area", "m^2", of_particles, list, 1});
  all.insert(all.end(), {{"fragment", "-", "lowest particle number of its fragment",
                          FieldPlace::particle, 1, true},
                         {"damage", "-", damage_meaning(scene), FieldPlace::particle, 1}});
  if (!scene.space)  // no grains there
    all.push_back({"parent", "-",
                   "lowest number of the grains of its particle; its own number if it has none",
                   FieldPlace::particle, 1, true});
  return all;
}

void append_bond_frame(const World& world, std::vector<std::vector<double>>& fields) {
  if (!world.has<BondTotals>()) return;
  append_places(world, fields);
  const Fragments& found = world.resource<Fragments>();
  std::vector<double> number, particles, size;
  for (const FragmentSize& fragment : fragments_of(world)) {
    number.push_back(fragment.number);
    particles.push_back(fragment.particles);
    size.push_back(fragment.size);
  }
  fields.insert(fields.end(), {number, particles, size});
  fields.emplace_back(found.of_particle.begin(), found.of_particle.end());
  std::vector<double>& of_particle = fields.emplace_back();
  for (std::size_t p = 0; p < found.bonded.size(); ++p)
    of_particle.push_back(damage(found.bonded[p], found.broken[p]));
  if (in_space(world)) return;
  fields.push_back(parents_of(world.resource<Bodies>()));
}

// ---- cracks -------------------------------------------------------------------------------------------
std::vector<TableInfo> bond_tables(const Scene& scene) {
  if (!has_bonds(scene)) return {};
  const char* place = "where it was then";
  const char* half = "half of it where the points of the other side break as well";
  const char* time = scene.initial_state
                         ? "when the point broke; <= 0: before the initial state was saved"
                         : "when the point broke";
  TableInfo cracks{"cracks", {{"time", "s", time}, {"x", "m", place}, {"y", "m", place}}};
  const auto add = [&](const SeriesInfo& column) { cracks.columns.push_back(column); };
  if (scene.space) add({"z", "m", place});
  add({"particle", "-",
       scene.space ? "number of the particle whose face it is on"
                   : "number of the particle whose edge it is on",
       true});
  add({"other", "-", other_meaning, true});
  add({"bond", "-", "position of its [[bond]] in the scene", true});
  add(scene.space ? SeriesInfo{"area", "m^2", half} : SeriesInfo{"length", "m", half});
  add({"shear", "-", "share of shear when it broke: 0 mode I, 1 mode II"});
  add({"energy", "J", "fracture energy of the bond law in the mode at breakage, times the area"});
  if (!scene.space) add({"inside", "-", "1 between grains of one particle, otherwise 0", true});
  return {cracks};
}

std::vector<std::vector<double>> crack_rows(const World& world, std::int64_t first) {
  std::vector<std::vector<double>> rows;
  if (!world.has<BondTotals>()) return rows;
  const Bodies& bodies = world.resource<Bodies>();
  const auto number = [&](int slot) { return slot < 0 ? slot : entry(bodies.slots, slot).number; };
  const auto parent = [&](int slot) { return entry(bodies.slots, slot).parent; };
  const std::vector<Crack>& cracks = world.resource<BondTotals>().cracks;
  const bool space = in_space(world);
  for (std::int64_t i = first; i < std::ssize(cracks); ++i) {
    const Crack& crack = entry(cracks, i);
    std::vector<double>& row = rows.emplace_back();
    row = {crack.time, crack.x, crack.y};
    if (space) row.push_back(crack.z);
    row.insert(row.end(), {1.0 * number(crack.slot), 1.0 * number(crack.other), crack.law - 1.0,
                           crack.size, crack.shear, crack.energy});
    if (space) continue;
    const bool inside = crack.other >= 0 && parent(crack.slot) == parent(crack.other);
    row.push_back(inside ? 1.0 : 0.0);
  }
  return rows;
}

// ---- summary ------------------------------------------------------------------------------------------
std::optional<BondFindings> bond_findings(const World& world) {
  if (!world.has<BondTotals>() || world.resource<Fragments>().of_particle.empty())
    return std::nullopt;
  const BondTotals& bonds = world.resource<BondTotals>();
  const Fragments& found = world.resource<Fragments>();
  BondFindings findings;
  findings.space = in_space(world);
  findings.broken = std::ssize(bonds.cracks);
  findings.made = std::accumulate(found.points.begin(), found.points.end(), findings.broken);
  findings.crack_size = bonds.crack_size;
  findings.fracture_energy = bonds.fracture;
  double shear = 0;
  for (const Crack& crack : bonds.cracks) {
    shear += crack.shear * crack.energy;
    findings.crack_energy += crack.energy;
  }
  if (findings.crack_energy > 0) findings.shear_share = shear / findings.crack_energy;
  const double damage = total_damage(found);
  if (damage >= 0) findings.damage = damage;
  findings.fragments = fragments_of(world);
  findings.largest_share = largest_share(findings.fragments);
  return findings;
}

}  // namespace pulvis

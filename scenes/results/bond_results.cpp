#include "scenes/results/bond_results.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "components/bond.hpp"
#include "components/space/shape.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/results/solids/bonded_faces.hpp"
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

BondLines bond_lines(const World& world) {
  BondLines bonds;
  if (world.has<CurveAnchor>()) bonds.add<Contact>(world);
  if (world.has<ToolAnchor>()) bonds.add<ToolContact>(world);
  return bonds;
}

// At their current positions.
Lines crack_lines(const World& world) {
  Lines lines;
  if (!world.has<CurvePosition>()) return lines;
  const Outlines outlines = outlines_of(world);
  for (const Crack& crack : world.resource<BondTotals>().cracks)
    lines.add(outlines.edge(crack.slot, crack.edge), crack.point, crack.point);
  return lines;
}

constexpr const char* mean_damage = "mean of its bonded points, 0 ... 1";
constexpr const char* other_meaning =
    "number of the other particle; for a tool: -1 - its position in the scene";
const char* damage_meaning(const Scene& scene) {
  return scene.in_space()
             ? "broken share of the area bonded at the start; NaN if nothing was bonded"
             : "broken share of the length bonded at the start; NaN if nothing was bonded";
}

// Where the bonds and cracks are: lines in two dimensions; in three one entry per bonded face, and points of the cracks.
void add_places_in_space(FrameFields& all) {
  using space::BondedFaces;
  constexpr auto list = FieldPlace::list;
  all.add(
      [](const Observation& now) { return space::bonded_faces(now.world); },
      {{{"bonds/ids", "-", "bonded particles",
         std::string("number of the particle whose face it is; ") + other_meaning, list, 2, true},
        &BondedFaces::ids},
       {{"bonds/area", "m^2", "bonded area $A$",
         "as in bonds/area: half of it where the other side is listed as well", list, 1},
        &BondedFaces::area},
       {{"bonds/damage", "-", "damage of the bonds $D$", mean_damage, list, 1},
        &BondedFaces::damage},
       {{"bonds/position", "m", "centre of the bond $x$", "mean of its bonded points", list, 3},
        &BondedFaces::position}});
  all.add({{{"cracks/position", "m", "position of the crack $x$",
             "of every row of /cracks so far: where its point is now", list, 3},
            [](const Observation& now) { return space::crack_positions(now.world); }}});
}

void add_places_in_the_plane(FrameFields& all) {
  constexpr auto list = FieldPlace::list;
  const char* along_edge = "of a line along the bonded part of an edge";
  const char* of_crack = "of every row of /cracks so far: its part of the edge, where it is now";
  all.add(
      [](const Observation& now) { return bond_lines(now.world); },
      {{{"bonds/ids", "-", "bonded particles",
         std::string("number of the particle whose edge it is; ") + other_meaning, list, 2, true},
        &BondLines::ids},
       {{"bonds/length", "m", "bonded length $\\ell$",
         "as in bonds/area: half of it where the other side has a line as well", list, 1},
        &BondLines::length},
       {{"bonds/damage", "-", "damage of the bonds $D$", mean_damage, list, 1}, &BondLines::damage},
       {{"bonds/start", "m", "start of the bond $x$", along_edge, list, 2},
        [](BondLines&& bonds) { return std::move(bonds.lines.start); }},
       {{"bonds/end", "m", "end of the bond $x$", along_edge, list, 2},
        [](BondLines&& bonds) { return std::move(bonds.lines.end); }}});
  all.add([](const Observation& now) { return crack_lines(now.world); },
          {{{"cracks/start", "m", "start of the crack $x$", of_crack, list, 2}, &Lines::start},
           {{"cracks/end", "m", "end of the crack $x$", of_crack, list, 2}, &Lines::end}});
}

struct BondFigures {
  double area = 0, crack_size = 0;  // m^2; m, in three dimensions m^2
  double damage = 0, fragments = 0, largest_share = 0;
};

BondFigures bond_figures(const Observation& now) {
  const BondTotals& bonds = now.world.resource<BondTotals>();
  const std::vector<FragmentSize> fragments = fragments_of(now.world);
  return {bonds.area, bonds.crack_size, total_damage(now.world.resource<Fragments>()),
          static_cast<double>(fragments.size()), largest_share(fragments)};
}

// One entry of each list per fragment.
struct FragmentLists {
  std::vector<double> number, particles, size;
};

FragmentLists fragment_lists(const Observation& now) {
  FragmentLists lists;
  for (const FragmentSize& fragment : fragments_of(now.world)) {
    lists.number.push_back(fragment.number);
    lists.particles.push_back(fragment.particles);
    lists.size.push_back(fragment.size);
  }
  return lists;
}

std::vector<double> fragment_of_particles(const Observation& now) {
  const std::vector<std::int32_t>& of = now.world.resource<Fragments>().of_particle;
  return {of.begin(), of.end()};
}

std::vector<double> damage_of_particles(const Observation& now) {
  const Fragments& found = now.world.resource<Fragments>();
  std::vector<double> of_particle;
  for (std::size_t p = 0; p < found.bonded.size(); ++p)
    of_particle.push_back(damage(found.bonded[p], found.broken[p]));
  return of_particle;
}

}  // namespace

// ---- series -------------------------------------------------------------------------------------------
void add_bond_series(const Scene& scene, Observables& all) {
  if (!has_bonds(scene)) return;
  const bool space = scene.in_space();
  all.add(bond_figures,
          {{"bonds/area", "m^2", "bonded area $A$", "of the bonded surfaces", &BondFigures::area},
           {space ? "bonds/crack_area" : "bonds/crack_length", space ? "m^2" : "m",
            space ? "crack area $A$" : "crack length $\\ell$", "of all cracks so far",
            &BondFigures::crack_size},
           {"bonds/damage", "-", "damage of the bonds $D$", damage_meaning(scene),
            &BondFigures::damage},
           {"bonds/fragments", "-", "fragments",
            "pieces held together by bonds, including loose particles", &BondFigures::fragments},
           {"bonds/largest_fragment", "-", "share of the largest fragment",
            space ? "volume of the largest fragment / volume of the particles"
                  : "area of the largest fragment / area of the particles",
            &BondFigures::largest_share}});
}

// ---- frames -------------------------------------------------------------------------------------------
void add_bond_fields(const Scene& scene, FrameFields& all) {
  if (!has_bonds(scene)) return;
  const bool space = scene.in_space();
  constexpr auto list = FieldPlace::list, particle = FieldPlace::particle;
  if (space)
    add_places_in_space(all);
  else
    add_places_in_the_plane(all);
  all.add(fragment_lists, {{{"fragments/number", "-", "fragment",
                             "lowest particle number of each fragment", list, 1, true},
                            &FragmentLists::number},
                           {{"fragments/particles", "-", "particles of the fragment",
                             "number of its particles", list, 1, true},
                            &FragmentLists::particles},
                           {{space ? "fragments/volume" : "fragments/area", space ? "m^3" : "m^2",
                             space ? "volume of the fragment $V$" : "area of the fragment $A$",
                             "of its particles, undeformed", list, 1},
                            &FragmentLists::size}});
  all.add(
      {{{"fragment", "-", "fragment", "lowest particle number of its fragment", particle, 1, true},
        fragment_of_particles},
       {{"damage", "-", "damage $D$", damage_meaning(scene), particle, 1}, damage_of_particles},
       {{"parent", "-", "parent particle",
         "lowest number of the grains of its particle; its own number if it has none", particle, 1,
         true},
        [](const Observation& now) { return parents_of(now.world.resource<Bodies>()); },
        !space}});  // no grains there
}

// ---- cracks -------------------------------------------------------------------------------------------
namespace {

// A column of /cracks: its description, and its value for a crack.
struct CrackColumn {
  SeriesInfo info;
  std::function<double(const Bodies&, const Crack&)> read;
  bool exists = true;
};

double number_in_slot(const Bodies& bodies, int slot) {
  return slot < 0 ? slot : entry(bodies.slots, slot).number;
}

bool is_inside_a_particle(const Bodies& bodies, const Crack& crack) {
  return crack.other >= 0 &&
         entry(bodies.slots, crack.slot).parent == entry(bodies.slots, crack.other).parent;
}

// `resumes`: the run starts from a saved state.
std::vector<CrackColumn> crack_columns(bool space, bool resumes) {
  const auto value = [](double Crack::*member) {
    return [member](const Bodies&, const Crack& crack) { return crack.*member; };
  };
  const char* place = "where it was then";
  std::vector<CrackColumn> all{
      {{"time", "s", "time of breakage $t$",
        resumes ? "when the point broke; <= 0: before the initial state was saved"
                : "when the point broke"},
       value(&Crack::time)},
      {{"x", "m", "position $x$", place}, value(&Crack::x)},
      {{"y", "m", "position $y$", place}, value(&Crack::y)},
      {{"z", "m", "position $z$", place}, value(&Crack::z), space},
      {{"particle", "-", "particle",
        space ? "number of the particle whose face it is on"
              : "number of the particle whose edge it is on",
        true},
       [](const Bodies& bodies, const Crack& crack) { return number_in_slot(bodies, crack.slot); }},
      {{"other", "-", "other particle or tool", other_meaning, true},
       [](const Bodies& bodies, const Crack& crack) {
         return number_in_slot(bodies, crack.other);
       }},
      {{"bond", "-", "bond of the scene", "position of its [[bond]] in the scene", true},
       [](const Bodies&, const Crack& crack) { return crack.law - 1.0; }},
      {{space ? "area" : "length", space ? "m^2" : "m",
        space ? "crack area $A$" : "crack length $\\ell$",
        "half of it where the points of the other side break as well"},
       value(&Crack::size)},
      {{"shear", "-", "share of shear", "share of shear when it broke: 0 mode I, 1 mode II"},
       value(&Crack::shear)},
      {{"energy", "J", "fracture energy $E$",
        "fracture energy of the bond law in the mode at breakage, times the area"},
       value(&Crack::energy)},
      {{"inside", "-", "inside a particle", "1 between grains of one particle, otherwise 0", true},
       [](const Bodies& bodies, const Crack& crack) {
         return is_inside_a_particle(bodies, crack) ? 1.0 : 0.0;
       },
       !space}};
  std::erase_if(all, [](const CrackColumn& column) { return !column.exists; });
  return all;
}

}  // namespace

std::vector<TableInfo> bond_tables(const Scene& scene) {
  if (!has_bonds(scene)) return {};
  TableInfo cracks{"cracks", {}};
  for (CrackColumn& column : crack_columns(scene.in_space(), scene.initial_state.has_value()))
    cracks.columns.push_back(std::move(column.info));
  return {cracks};
}

std::vector<std::vector<double>> crack_rows(const World& world, std::int64_t first) {
  std::vector<std::vector<double>> rows;
  if (!world.has<BondTotals>()) return rows;
  const std::vector<Crack>& cracks = world.resource<BondTotals>().cracks;
  if (first >= std::ssize(cracks)) return rows;
  const std::vector<CrackColumn> columns = crack_columns(in_space(world), false);
  for (std::int64_t i = first; i < std::ssize(cracks); ++i) {
    std::vector<double>& row = rows.emplace_back();
    for (const CrackColumn& column : columns)
      row.push_back(column.read(world.resource<Bodies>(), entry(cracks, i)));
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

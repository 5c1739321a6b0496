#include "scenes/space/results/observed_network.hpp"

#include <algorithm>
#include <string>

#include "components/observed.hpp"
#include "components/space/observed.hpp"
#include "systems/observe/network_kernel.hpp"
#include "systems/space/observe/network_kernel.hpp"

namespace pulvis::space {
namespace {

struct ContactCounts {
  std::vector<double> pairs, tools;  // [particles]
};

ContactCounts contact_counts(const World& world) {
  const auto& network = world.resource<ContactNetwork>();
  const auto particles = static_cast<std::size_t>(world.resource<Bodies>().particles());
  ContactCounts counts{std::vector<double>(particles), std::vector<double>(particles)};
  pulvis::kernels::count_contacts(network.pairs, true, counts.pairs);
  pulvis::kernels::count_contacts(network.tools, false, counts.tools);
  return counts;
}

double share_of_chains(const std::vector<std::int32_t>& chain) {
  const auto in_none = std::ranges::count(chain, 0);
  return 1 - static_cast<double>(in_none) / static_cast<double>(chain.size());
}

std::vector<FieldInfo> link_fields(const std::string& group, bool pairs) {
  const auto field = [&](const char* name, const char* unit, const char* meaning, int components,
                         bool whole = false) {
    return FieldInfo{group + "/" + name, unit, meaning, FieldPlace::list, components, whole};
  };
  return {field("ids", "-",
                pairs ? "numbers of the two particles"
                      : "number of the particle, position of the tool in the scene",
                2, true),
          field("point", "m", "where it acts: mean of the points, weighted with their forces", 3),
          field("normal", "-", "unit vector into the first particle", 3),
          field("force", "N", "on the first particle", 3),
          field("normal_force", "N", "along the normal; compression > 0", 1),
          field("tangential_force", "N", "across the normal; >= 0", 1),
          field("area", "m^2", "of the surface that touches", 1)};
}

void append_link_fields(const std::vector<ContactLink>& links,
                        std::vector<std::vector<double>>& fields) {
  const auto column = [&](const auto& add) {
    std::vector<double>& values = fields.emplace_back();
    for (const ContactLink& link : links) add(link, values);
  };
  const auto add_point = [](const Point& p, std::vector<double>& to) {
    to.insert(to.end(), p.begin(), p.end());
  };
  column([](const ContactLink& l, auto& to) {
    to.insert(to.end(), {static_cast<double>(l.first), static_cast<double>(l.second)});
  });
  column([&](const ContactLink& l, auto& to) { add_point(l.point, to); });
  column([&](const ContactLink& l, auto& to) { add_point(l.normal, to); });
  column([&](const ContactLink& l, auto& to) { add_point(l.force, to); });
  column([](const ContactLink& l, auto& to) { to.push_back(l.normal_force()); });
  column([](const ContactLink& l, auto& to) { to.push_back(l.tangential_force()); });
  column([](const ContactLink& l, auto& to) { to.push_back(l.area); });
}

}  // namespace

void add_observed_network(World& world, const Scene& scene) {
  if (!scene.output.contacts) return;
  world.emplace<ContactNetwork>();
  world.emplace<ForceChains>();
}

std::vector<SeriesInfo> network_series(const Scene& scene) {
  if (!scene.output.contacts) return {};
  std::vector<SeriesInfo> all{
      {"network/coordination", "-", "other particles that a particle touches, mean"},
      {"network/tools", "-", "tools that a particle touches, mean"},
      {"network/rattlers", "-", "share of particles that touch fewer than two others or tools"}};
  for (const char* part : {"xx", "yy", "zz", "xy", "yz", "zx"})
    all.push_back({std::string("network/fabric_") + part, "-",
                   "fabric tensor of the contacts between particles"});
  all.insert(all.end(),
             {{"network/anisotropy", "-", "of the fabric tensor: 0 isotropic, 1 all parallel"},
              {"network/mean_force", "N", "normal, between particles"},
              {"network/largest_force", "N", "normal, between particles"},
              {"network/chain_share", "-", "share of particles in force chains"}});
  return all;
}

std::vector<FieldInfo> network_fields(const World& world) {
  if (!world.has<ContactNetwork>()) return {};
  std::vector<FieldInfo> all = link_fields("contacts", true);
  for (const FieldInfo& field : link_fields("tool_contacts", false)) all.push_back(field);
  all.insert(
      all.end(),
      {{"coordination", "-", "other particles that it touches", FieldPlace::particle, 1, true},
       {"tools_touched", "-", "tools that it touches", FieldPlace::particle, 1, true},
       {"force_chain", "-", "number of its force chain; 0: in none", FieldPlace::particle, 1,
        true}});
  return all;
}

void append_network_sample(const World& world, std::vector<double>& row) {
  if (!world.has<ContactNetwork>()) return;
  const auto& network = world.resource<ContactNetwork>();
  const auto particles = static_cast<double>(world.resource<Bodies>().particles());
  const ContactCounts counts = contact_counts(world);
  double rattlers = 0;
  for (std::size_t p = 0; p < counts.pairs.size(); ++p)
    if (counts.pairs[p] + counts.tools[p] < 2) rattlers += 1;
  const kernels::Fabric fabric = kernels::fabric(network.pairs);
  const pulvis::kernels::ForceSizes sizes = pulvis::kernels::force_sizes(network.pairs);
  row.insert(row.end(),
             {2 * static_cast<double>(network.pairs.size()) / particles,
              static_cast<double>(network.tools.size()) / particles, rattlers / particles,
              fabric.xx, fabric.yy, fabric.zz, fabric.xy, fabric.yz, fabric.zx, fabric.anisotropy(),
              sizes.mean, sizes.maximum, share_of_chains(world.resource<ForceChains>().chain)});
}

void append_network_frame(const World& world, std::vector<std::vector<double>>& fields) {
  if (!world.has<ContactNetwork>()) return;
  const auto& network = world.resource<ContactNetwork>();
  append_link_fields(network.pairs, fields);
  append_link_fields(network.tools, fields);
  const ContactCounts counts = contact_counts(world);
  fields.push_back(counts.pairs);
  fields.push_back(counts.tools);
  const auto& chain = world.resource<ForceChains>().chain;
  fields.emplace_back(chain.begin(), chain.end());
}

}  // namespace pulvis::space

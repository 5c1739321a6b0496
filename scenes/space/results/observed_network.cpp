#include "scenes/space/results/observed_network.hpp"

#include <string>

#include "components/observed.hpp"
#include "components/space/contact.hpp"
#include "scenes/results/parts/network_results.hpp"
#include "systems/space/observe/network_kernel.hpp"

namespace pulvis::space {
namespace {

constexpr LinkWords link_words{3, "tangential to the surface; >= 0", "area", "m^2",
                               "of the surface in contact"};

ContactCounts contact_counts(const World& world) {
  return {world.resource<ContactNetwork<ThreeD>>(), world.resource<Bodies>().particles()};
}

}  // namespace

void add_observed_network(World& world, const Scene& scene) {
  if (!scene.output.contacts) return;
  world.emplace<ContactNetwork<ThreeD>>();
  world.emplace<ForceChains>();
  if (world.has<ContactPoint>()) world.add<ContactPointForce>();
}

std::vector<SeriesInfo> network_series(const Scene& scene) {
  if (!scene.output.contacts) return {};
  std::vector<SeriesInfo> all{
      {"network/coordination", "-", "mean number of other particles that a particle touches"},
      {"network/tools", "-", "mean number of tools that a particle touches"},
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
  if (!world.has<ContactNetwork<ThreeD>>()) return {};
  std::vector<FieldInfo> all = link_fields("contacts", true, link_words);
  for (const FieldInfo& field : link_fields("tool_contacts", false, link_words))
    all.push_back(field);
  all.insert(
      all.end(),
      {{"coordination", "-", "other particles that it touches", FieldPlace::particle, 1, true},
       {"tools_touched", "-", "tools that it touches", FieldPlace::particle, 1, true},
       {"force_chain", "-", "number of its force chain; 0: none", FieldPlace::particle, 1, true}});
  return all;
}

void append_network_sample(const World& world, std::vector<double>& row) {
  if (!world.has<ContactNetwork<ThreeD>>()) return;
  const auto& network = world.resource<ContactNetwork<ThreeD>>();
  const auto particles = static_cast<double>(world.resource<Bodies>().particles());
  const kernels::Fabric fabric = kernels::fabric(network.pairs);
  const pulvis::kernels::ForceSizes sizes = pulvis::kernels::force_sizes(network.pairs);
  row.insert(row.end(), {2 * static_cast<double>(network.pairs.size()) / particles,
                         static_cast<double>(network.tools.size()) / particles,
                         contact_counts(world).rattlers(), fabric.xx, fabric.yy, fabric.zz,
                         fabric.xy, fabric.yz, fabric.zx, fabric.anisotropy(), sizes.mean,
                         sizes.maximum, share_in_chains(world.resource<ForceChains>().chain)});
}

void append_network_frame(const World& world, std::vector<std::vector<double>>& fields) {
  if (!world.has<ContactNetwork<ThreeD>>()) return;
  const auto& network = world.resource<ContactNetwork<ThreeD>>();
  append_links(network.pairs, fields);
  append_links(network.tools, fields);
  append_counts(contact_counts(world), world.resource<ForceChains>().chain, fields);
}

}  // namespace pulvis::space

// output.contacts: the contact network, its overall measures and its links.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include "components/observed.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "systems/observe/network_kernel.hpp"
#include "systems/space/observe/network_kernel.hpp"

namespace pulvis {
namespace {

// Contacts of every particle, by number.
struct ParticleContacts {
  std::vector<double> pairs, tools, chain;

  // Share of the particles that touch fewer than two other particles or tools.
  double rattlers() const {
    double number = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p] + tools[p] < 2) number += 1;
    return number / static_cast<double>(pairs.size());
  }
  double share_in_chains() const {
    const auto in_none = std::ranges::count(chain, 0.0);
    return 1 - static_cast<double>(in_none) / static_cast<double>(chain.size());
  }
};

template <class D>
ParticleContacts contacts_of_particles(const Observation& now) {
  const auto& network = now.world.resource<ContactNetwork<D>>();
  const std::vector<std::int32_t>& chain = now.world.resource<ForceChains>().chain;
  const auto particles = static_cast<std::size_t>(now.world.resource<Bodies>().particles());
  ParticleContacts of{std::vector<double>(particles), std::vector<double>(particles),
                      std::vector<double>(chain.begin(), chain.end())};
  kernels::count_contacts(network.pairs, true, of.pairs);
  kernels::count_contacts(network.tools, false, of.tools);
  return of;
}

struct NetworkFigures {
  double coordination = 0, tools = 0, rattlers = 0;
  space::kernels::Fabric fabric;
  double anisotropy = 0, angle = 0;          // -; rad, only in two dimensions
  double mean_force = 0, largest_force = 0;  // N
  double chain_share = 0;
};

void set_fabric(const std::vector<ContactLink<TwoD>>& pairs, NetworkFigures& f) {
  const kernels::Fabric fabric = kernels::fabric(pairs);
  f.fabric.xx = fabric.xx, f.fabric.xy = fabric.xy, f.fabric.yy = fabric.yy;
  f.anisotropy = fabric.anisotropy();
  f.angle = fabric.angle();
}

void set_fabric(const std::vector<ContactLink<ThreeD>>& pairs, NetworkFigures& f) {
  f.fabric = space::kernels::fabric(pairs);
  f.anisotropy = f.fabric.anisotropy();
}

template <class D>
NetworkFigures network_figures(const Observation& now) {
  const auto& network = now.world.resource<ContactNetwork<D>>();
  const auto particles = static_cast<double>(now.world.resource<Bodies>().particles());
  const ParticleContacts of_particles = contacts_of_particles<D>(now);
  const kernels::ForceSizes sizes = kernels::force_sizes(network.pairs);
  NetworkFigures f;
  f.coordination = 2 * static_cast<double>(network.pairs.size()) / particles;
  f.tools = static_cast<double>(network.tools.size()) / particles;
  f.rattlers = of_particles.rattlers();
  set_fabric(network.pairs, f);
  f.mean_force = sizes.mean;
  f.largest_force = sizes.maximum;
  f.chain_share = of_particles.share_in_chains();
  return f;
}

std::vector<Observable<NetworkFigures>> network_rows(bool space) {
  const auto fabric = [](double space::kernels::Fabric::*part) {
    return [part](const NetworkFigures& f) { return f.fabric.*part; };
  };
  using Fabric = space::kernels::Fabric;
  const char* tensor = "fabric tensor of the contacts between particles";
  return {
      {"network/coordination", "-", "coordination number $Z$",
       "mean number of other particles that a particle touches", &NetworkFigures::coordination},
      {"network/tools", "-", "tools a particle touches",
       "mean number of tools that a particle touches", &NetworkFigures::tools},
      {"network/rattlers", "-", "share of rattlers",
       "share of particles that touch fewer than two others or tools", &NetworkFigures::rattlers},
      {"network/fabric_xx", "-", "fabric tensor $F_{xx}$", tensor, fabric(&Fabric::xx)},
      {"network/fabric_xy", "-", "fabric tensor $F_{xy}$", tensor, fabric(&Fabric::xy), !space},
      {"network/fabric_yy", "-", "fabric tensor $F_{yy}$", tensor, fabric(&Fabric::yy)},
      {"network/fabric_zz", "-", "fabric tensor $F_{zz}$", tensor, fabric(&Fabric::zz), space},
      {"network/fabric_xy", "-", "fabric tensor $F_{xy}$", tensor, fabric(&Fabric::xy), space},
      {"network/fabric_yz", "-", "fabric tensor $F_{yz}$", tensor, fabric(&Fabric::yz), space},
      {"network/fabric_zx", "-", "fabric tensor $F_{zx}$", tensor, fabric(&Fabric::zx), space},
      {"network/anisotropy", "-", "anisotropy of the fabric $a$",
       space ? "of the fabric tensor: 0 isotropic, 1 all parallel"
             : "difference of the fabric tensor's principal values",
       &NetworkFigures::anisotropy},
      {"network/fabric_angle", "rad", "direction of the fabric $\\theta$",
       "of the preferred direction of the contacts, from x", &NetworkFigures::angle, !space},
      {"network/mean_force", "N", "mean normal force $F_n$", "normal, between particles",
       &NetworkFigures::mean_force},
      {"network/largest_force", "N", "largest normal force $F_n$", "normal, between particles",
       &NetworkFigures::largest_force},
      {"network/chain_share", "-", "share of particles in force chains",
       "share of particles in force chains", &NetworkFigures::chain_share}};
}

// ---- links --------------------------------------------------------------------------------------------
// What differs between two and three dimensions.
struct LinkWords {
  const char* tangential;                    // what tangential_force is
  const char *extent, *unit, *label, *what;  // of the contact size
};

constexpr LinkWords plane_links{"along the normal rotated by 90 degrees", "length", "m",
                                "contact length $\\ell$",
                                "of the surface in contact; times thickness: area"};
constexpr LinkWords space_links{"tangential to the surface; >= 0", "area", "m^2",
                                "contact area $A$", "of the surface in contact"};

template <class D>
using Links = const std::vector<ContactLink<D>>*;

// Of all links, one after the other.
template <class D, class Append>
auto column_of(const Append& append) {
  return [append](Links<D> links) {
    std::vector<double> values;
    for (const ContactLink<D>& link : *links) append(link, values);
    return values;
  };
}
template <class D>
auto vector_of_links(typename D::Point ContactLink<D>::*vector) {
  return column_of<D>([vector](const ContactLink<D>& l, std::vector<double>& to) {
    to.insert(to.end(), (l.*vector).begin(), (l.*vector).end());
  });
}
template <class D, class Read>
auto number_of_links(Read read) {
  return column_of<D>([read](const ContactLink<D>& l, std::vector<double>& to) {
    to.push_back(std::invoke(read, l));
  });
}

template <class D>
std::vector<FrameField<Links<D>>> link_fields(const std::string& group, const char* ids,
                                              const LinkWords& words) {
  using Link = ContactLink<D>;
  constexpr auto list = FieldPlace::list;
  constexpr int n = D::axes;
  return {{{group + "/ids", "-", "bodies in contact", ids, list, 2, true},
           column_of<D>([](const Link& l, std::vector<double>& to) {
             to.insert(to.end(), {static_cast<double>(l.first), static_cast<double>(l.second)});
           })},
          {{group + "/point", "m", "point of action $x$",
            "point of action: mean of the contact points, weighted by their forces", list, n},
           vector_of_links<D>(&Link::point)},
          {{group + "/normal", "-", "contact normal $n$", "unit vector into the first particle",
            list, n},
           vector_of_links<D>(&Link::normal)},
          {{group + "/force", "N", "contact force $F$", "on the first particle", list, n},
           vector_of_links<D>(&Link::force)},
          {{group + "/normal_force", "N", "normal force $F_n$", "along the normal; compression > 0",
            list, 1},
           number_of_links<D>(&Link::normal_force)},
          {{group + "/tangential_force", "N", "tangential force $F_t$", words.tangential, list, 1},
           number_of_links<D>(&Link::tangential_force)},
          {{group + "/" + words.extent, words.unit, words.label, words.what, list, 1},
           number_of_links<D>(&Link::size)}};
}

// Orientations of the contacts; only in two dimensions.
void add_rose(FrameFields& all) {
  using Rose = kernels::Rose;
  all.add(
      [](const Observation& now) {
        return kernels::rose(now.world.resource<ContactNetwork<TwoD>>().pairs);
      },
      {{{"rose/number", "-", "share of contacts",
         "share of the contacts between particles whose normal lies in each of 18 sectors, "
         "the first around the x axis",
         FieldPlace::list, 1},
        [](const Rose& r) { return std::vector<double>(r.number.begin(), r.number.end()); }},
       {{"rose/force", "-", "share of normal force", "the same, weighted with the normal force",
         FieldPlace::list, 1},
        [](const Rose& r) { return std::vector<double>(r.force.begin(), r.force.end()); }}});
}

template <class D>
void add_network(const LinkWords& words, FrameFields& all) {
  all.add([](const Observation& now) { return &now.world.resource<ContactNetwork<D>>().pairs; },
          link_fields<D>("contacts", "numbers of the two particles", words));
  all.add([](const Observation& now) { return &now.world.resource<ContactNetwork<D>>().tools; },
          link_fields<D>("tool_contacts",
                         "number of the particle, position of the tool in the scene", words));
  if constexpr (D::axes == 2) add_rose(all);
  constexpr auto particle = FieldPlace::particle;
  all.add(contacts_of_particles<D>,
          {{{"coordination", "-", "coordination number $Z$", "other particles that it touches",
             particle, 1, true},
            &ParticleContacts::pairs},
           {{"tools_touched", "-", "tools touched", "tools that it touches", particle, 1, true},
            &ParticleContacts::tools},
           {{"force_chain", "-", "force chain", "number of its force chain; 0: none", particle, 1,
             true},
            &ParticleContacts::chain}});
}

}  // namespace

void add_network_series(const Scene& scene, Observables& all) {
  if (!scene.output.contacts) return;
  const auto figures = scene.in_space() ? network_figures<ThreeD> : network_figures<TwoD>;
  all.add(figures, network_rows(scene.in_space()));
}

void add_network_fields(const Scene& scene, FrameFields& all) {
  if (!scene.output.contacts) return;
  if (scene.in_space())
    add_network<ThreeD>(space_links, all);
  else
    add_network<TwoD>(plane_links, all);
}

}  // namespace pulvis

// Output and counts of a contact network, for two and three dimensions. Link: ContactLink of either.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/files/record.hpp"
#include "systems/observe/network_kernel.hpp"

namespace pulvis {

struct ContactCounts {
  std::vector<double> pairs, tools;  // [particles]

  template <class Network>
  ContactCounts(const Network& network, int particles)
      : pairs(static_cast<std::size_t>(particles)), tools(static_cast<std::size_t>(particles)) {
    kernels::count_contacts(network.pairs, true, pairs);
    kernels::count_contacts(network.tools, false, tools);
  }
  // Share of the particles that touch fewer than two other particles or tools.
  double rattlers() const {
    double number = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p] + tools[p] < 2) number += 1;
    return number / static_cast<double>(pairs.size());
  }
};

// Share of the particles in force chains.
inline double share_in_chains(const std::vector<std::int32_t>& chain) {
  const auto in_none = std::ranges::count(chain, 0);
  return 1 - static_cast<double>(in_none) / static_cast<double>(chain.size());
}

// What differs between two and three dimensions.
struct LinkWords {
  int components;                    // of a vector
  const char* tangential;            // what tangential_force is
  const char *extent, *unit, *what;  // name of the contact size
};

inline std::vector<FieldInfo> link_fields(const std::string& group, bool pairs,
                                          const LinkWords& words) {
  const auto field = [&](const char* name, const char* unit, const char* meaning, int components,
                         bool whole = false) {
    return FieldInfo{group + "/" + name, unit, meaning, FieldPlace::list, components, whole};
  };
  const int n = words.components;
  return {field("ids", "-",
                pairs ? "numbers of the two particles"
                      : "number of the particle, position of the tool in the scene",
                2, true),
          field("point", "m",
                "point of action: mean of the contact points, weighted by their forces", n),
          field("normal", "-", "unit vector into the first particle", n),
          field("force", "N", "on the first particle", n),
          field("normal_force", "N", "along the normal; compression > 0", 1),
          field("tangential_force", "N", words.tangential, 1),
          field(words.extent, words.unit, words.what, 1)};
}

template <class Link>
void append_links(const std::vector<Link>& links, std::vector<std::vector<double>>& fields) {
  const auto column = [&](const auto& add) {
    std::vector<double>& values = fields.emplace_back();
    for (const Link& link : links) add(link, values);
  };
  const auto vector_of = [&](auto Link::*vector) {
    column([vector](const Link& l, auto& to) {
      to.insert(to.end(), (l.*vector).begin(), (l.*vector).end());
    });
  };
  column([](const Link& l, auto& to) {
    to.insert(to.end(), {static_cast<double>(l.first), static_cast<double>(l.second)});
  });
  vector_of(&Link::point);
  vector_of(&Link::normal);
  vector_of(&Link::force);
  column([](const Link& l, auto& to) { to.push_back(l.normal_force()); });
  column([](const Link& l, auto& to) { to.push_back(l.tangential_force()); });
  column([](const Link& l, auto& to) { to.push_back(l.size); });
}

// Per particle: contacts with particles, contacts with tools, number of its force chain.
inline void append_counts(const ContactCounts& counts, const std::vector<std::int32_t>& chain,
                          std::vector<std::vector<double>>& fields) {
  fields.push_back(counts.pairs);
  fields.push_back(counts.tools);
  fields.emplace_back(chain.begin(), chain.end());
}

}  // namespace pulvis

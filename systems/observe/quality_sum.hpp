// Sums of contact qualities over all contacts of all ranks.
#pragma once

#include <array>
#include <vector>

#include "components/observed.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

// Exact, and hence the same for any number of ranks.
inline ContactQuality exact_sum(const std::vector<ContactQuality>& of_contacts, const Link& link) {
  constexpr std::array numbers{&ContactQuality::overlap,      &ContactQuality::penetration_work,
                               &ContactQuality::force,        &ContactQuality::narrow_force,
                               &ContactQuality::narrow_width, &ContactQuality::narrow_edges};
  std::array<ExactSum, numbers.size()> sums;
  for (const ContactQuality& of_one : of_contacts)
    for (std::size_t i = 0; i < numbers.size(); ++i) sums[i].add(of_one.*numbers[i]);
  sum_of_ranks(link, sums);
  ContactQuality all;
  for (std::size_t i = 0; i < numbers.size(); ++i) all.*numbers[i] = sums[i].value();
  return all;
}

}  // namespace pulvis

// Whether a scene asks for the elastic response of its powder, which soft contact springs falsify: they act in series with
// the particles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// -, contact.stiffness from which on springs change moduli and springback by some 5% at most.
inline constexpr double stiff_contacts = 10;

// "contact.stiffness = 10", and what it costs.
std::string advice_of_stiff_contacts();

// "stage 'release' unloads the powder", of the first stage that asks for it; none: the scene only loads.
std::optional<std::string> asks_for_elastic_response(const Scene& scene);

// One line at most, as a list like those of all warnings.
std::vector<std::string> soft_contact_warnings(const Scene& scene);

// With a reason of the caller's, as "the probe measures moduli"; empty if the contacts are stiff.
std::string soft_contact_warning(const Scene& scene, const std::string& reason);

}  // namespace pulvis

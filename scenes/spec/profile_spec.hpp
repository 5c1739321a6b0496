// The relief of a target surface, as plain values.
#pragma once

#include <optional>

namespace pulvis {

// Relief of a target surface: heights below its crests against x. Repeated, or generated, as far as
// the powder can reach.
struct ProfileSpec {
  enum class Kind { flat, triangle, sine, trapezoid, rough, file } kind = Kind::flat;
  double pitch = 0;               // m, from crest to crest
  std::optional<double> depth;    // m, from crest to valley; or
  std::optional<double> ra;       // m, arithmetic mean deviation from the mean line
  double flat_share = 0.25;       // -, of the pitch: length of a trapezoid's crest, and of its valley
  double correlation_length = 0;  // m, of a rough profile
};

}  // namespace pulvis

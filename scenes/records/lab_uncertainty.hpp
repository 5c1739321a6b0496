// A value with what makes it unsure: the scatter of its samples, and instruments whose uncertainty is stated.
//
// Source   JCGM 100:2008 (GUM): contributions add as squares; the interval is that of Student's distribution with
//          u^4 / (u_scatter^4 / v_scatter) degrees of freedom (Welch-Satterthwaite, G.4; those of stated
//          uncertainties count as without end)
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis::lab {

struct Contribution {
  std::string source;  // "scatter", "height", ...
  double error = 0;    // one standard uncertainty, in the value's unit
};

struct Measured {
  std::string name, unit;
  double value = 0;
  double freedom = 1;                       // degrees, of the first contribution
  std::vector<Contribution> contributions;  // scatter first

  double standard() const;                     // u
  double half_width(double confidence) const;  // of the interval
};

}  // namespace pulvis::lab

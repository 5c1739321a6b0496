// A value and its sources of uncertainty: the scatter of its samples, and instruments with a stated one.
//
// Source   JCGM 100:2008 (GUM): contributions add in quadrature; the interval is from Student's distribution with
//          u^4 / (u_scatter^4 / v_scatter) degrees of freedom (Welch-Satterthwaite, G.4; stated
//          uncertainties count as having infinitely many)
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis::lab {

struct Contribution {
  std::string source;  // "scatter", "height", ...
  double error = 0;    // one standard uncertainty, in the value's unit; infinite: not determined
};

struct Measured {
  std::string name, unit;
  double value = 0;
  double freedom = 1;                       // degrees of freedom of the first contribution
  std::vector<Contribution> contributions;  // scatter first

  double standard() const;                     // u
  double half_width(double confidence) const;  // of the confidence interval
  bool has_interval() const;                   // its half width is finite
};

}  // namespace pulvis::lab

// Yield surfaces of powders, fitted to yield points.
//
// p: pressure, q: von Mises stress, both Pa.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cli/campaigns/probe/yield_models.hpp"
#include "cli/campaigns/probe/yield_points.hpp"

namespace pulvis {

// The values of a parameter with which the model fits as well, with a confidence of 95%, when its other parameters follow.
struct ParameterRange {
  std::string name;
  double
      low = 0,
      high =
          0;  // 0, infinity: no bound within a factor of 10, of d up to the largest p; beta: pi/2
  // The range is no wider than the value itself, or for d and p_t than a tenth of the largest p, for alpha than 0.1.
  bool determined = true;
};

struct FittedModel {
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // Pa, rad or -
  YieldModel::Terms terms = YieldModel::Terms::invariants;
  std::vector<ParameterRange>
      ranges;         // of the fitted parameters, not of those that follow from them
  double misfit = 0;  // rms distance to the points along rays, over the largest pressure
  // For plotting, Pa: p and q along it. q >= 0; of models in terms of the stresses on both sides, in the plane of the axis.
  std::vector<std::pair<double, double>> surface;
  // Pa: xx, yy, zz of rows from the axis of pressures outwards; of models in terms of the stresses in three dimensions.
  std::vector<std::vector<std::array<double, 3>>> shell;
  double parameter(const std::string& of) const;
  // Whether the points determine it, or what it follows from.
  bool determines(const std::string& of) const;
};

// Null: it was not fitted.
const FittedModel* model_of(const std::vector<FittedModel>& models, const std::string& name);

// All models of yield_models. Those that are isotropic are fitted to the `usable` points, those in terms of the stresses to all
// that are `closed`. Fewer than five usable points: no models.
// Without bonds zero stress is an additional point of the cap: nothing holds the powder together.
std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points,
                                  const ProbedPowder& powder);

// Of the parameters that the points do not determine, with their ranges: "beta (50 to 90 deg), R (0.2 to 2.1)". Empty: none.
std::string undetermined(const FittedModel& model);

// Points whose opening pressure is at least a tenth of the largest: where the powder comes apart, what remains in plane strain
// is the stress zz that is locked into the particles, not a surface.
std::vector<bool> closed(const std::vector<YieldPoint>& points);

// Of these the ones with q > 0, compressed more along the axis, not by a probe in shear: a powder pressed along the axis has a
// different surface on the other side, which no isotropic model can represent.
std::vector<bool> usable(const std::vector<YieldPoint>& points);

// How many are used by the isotropic fits, and how many they need.
std::size_t usable_points(const std::vector<YieldPoint>& points);
inline constexpr std::size_t fewest_points = 5;

// Whether the model with these parameters is elastic at p, q: used by the fit and by whoever reads its parameters back.
bool is_elastic(const std::string& model,
                const std::vector<std::pair<std::string, double>>& parameters, double p, double q);

}  // namespace pulvis

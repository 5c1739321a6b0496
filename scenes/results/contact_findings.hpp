// What a run's contacts show about its mesh and its contact stiffness, from the first loading.
//
// Penetration  Surfaces that penetrate each other cost the tools extra displacement. By virtual work that is
//              u = sum(f g)/F, normal forces f and penetrations g of all contact points, F the force of the
//              tool under the largest force. In three dimensions sum(f g) is taken as twice the energy of the
//              contact springs. Rigid contacts would have given F at the approach a - u, with a = integral of
//              dW/F, W the work of the tools. So the force at a - u is too low by the share
//              1 - F(a - u)/F(a): all from the run's own curve
// Narrow       A contact narrower than two boundary edges, in three dimensions two faces, is not resolved; where
//              surfaces indent, one narrower than one (docs/accuracy.md)
// Range        up to the largest force before any shearing or unloading
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/observed.hpp"
#include "scenes/results/results.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct ContactFindings {
  // Larger values are reported. On a coarse mesh the estimate of the force is good to 0.03.
  static constexpr double most_narrow = 0.1;       // -, of the force
  static constexpr double max_force_error = 0.05;  // -

  std::optional<double> narrow_share;  // -, of the contact force, when that was largest
  double narrow_edges = 0;             // -, mean width of those contacts in boundary edges or faces
  bool indents = false;                // the surfaces
  double edge_to_do = 0;  // m, length of edges, or size of faces, of which they would span two
  std::optional<double> force_error;  // -, of the largest force, due to penetration: < 0, too low
  double stiffness = 0;               // -, the scene's contact.stiffness

  // None: the narrow ones are resolved by their indentation.
  std::optional<double> narrow_limit() const {
    return indents && narrow_edges >= 1 ? std::nullopt : std::optional(most_narrow);
  }
  bool too_narrow() const { return narrow_limit() && narrow_share > narrow_limit(); }
  bool too_soft() const { return force_error && *force_error < -max_force_error; }
  double stiffness_to_do() const;
};

// Inspects every sample.
class ContactLoading {
 public:
  explicit ContactLoading(const Scene& scene);
  void sample(const Results& results, const World& world);
  ContactFindings findings() const;

  // Stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(approach_, force_, sunk_, work_, heaviest_);
  }

 private:
  bool loads(const World& world) const;
  std::optional<double> force_error() const;

  std::vector<bool> loads_;  // [stages]
  bool in_space_ = false;
  bool indents_ = false;
  double stiffness_ = 0;
  std::vector<double> approach_, force_, sunk_;  // m, N, m: of every sample
  double work_ = 0;                              // J, of the tools so far
  ContactQuality heaviest_;                      // when the contact force was largest
};

}  // namespace pulvis

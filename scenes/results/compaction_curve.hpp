// Data for assessing a compaction in a die: forces on the four tools, density and size of the die, sample
// by sample; and the share of the top punch's force that reaches the bottom, compared with theory.
//
// Sources   round die: F_b = F_t exp(-4 mu nu L / (D (1 - nu)))   (thesis 3.1; D: here the width W)
//           slot, plane strain: F_b = F_t exp(-(mu_l + mu_r) K H / W), from the balance of a slice of the
//           compact whose walls carry K times the axial stress. Elastic: K = nu/(1 - nu); also with the K
//           measured in the run. Valid where the compact slides at both walls, away from one punch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/die_room.hpp"
#include "scenes/results/results.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {

struct CompactionSample {
  double density = 0;
  // N towards the tool; in three dimensions N/m: over the die's area by its width; lateral: mean of the walls.
  double top = 0, bottom = 0, lateral = 0;
  double width = 0, height = 0;  // m
  double bottom_place = 0;       // m, of the bottom punch, along the axis

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(density, top, bottom, lateral, width, height, bottom_place);
  }
};

class CompactionCurve {
 public:
  explicit CompactionCurve(const Scene& scene);
  void sample(const Results& results);  // does nothing where the scene has no die
  bool has_die() const { return cell_ || room_; }
  bool in_space() const { return room_.has_value(); }
  const std::vector<CompactionSample>& samples() const { return samples_; }
  std::vector<double> densities() const;
  std::vector<double> punch_pressures() const;  // Pa, top force / (width thickness)
  const std::string& top() const { return top_; }
  const std::string& bottom() const { return bottom_; }
  const std::string& left() const { return left_; }
  const std::string& right() const { return right_; }

  // Stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(samples_);
  }

 private:
  void sample_room(const Results& results);
  std::optional<DieCell> cell_;
  std::optional<DieRoom> room_;  // used instead of it in three dimensions
  std::string left_, right_, bottom_, top_;
  double thickness_ = 0;
  std::vector<CompactionSample> samples_;
};

// Friction coefficient at the die's walls; empty where there is no die, or no single value.
std::optional<double> wall_friction(const Scene& scene);

struct TransmissionShare {  // means over a part of the loading
  double density = 0;
  double height_over_width = 0;
  double lateral_ratio = 0;  // measured K: wall stress / mean axial stress
  double measured = 0;       // F_bottom / F_top
  std::optional<double> round_die, slot, slot_measured_ratio;
};

struct Transmission {
  std::string not_measured;  // why; empty: it was measured
  std::string not_compared;  // why there is no theory to compare with; empty: there is
  double wall_friction = 0, poissons_ratio = 0;
  std::vector<TransmissionShare> shares;  // ascending by density; the last one ends at the largest
};

Transmission transmission(const Scene& scene, const CompactionCurve& curve);

}  // namespace pulvis

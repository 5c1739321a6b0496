// Output of a run: history series, frame fields and the mesh, taken from an observed world.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/run_state.hpp"
#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/results/history_series.hpp"
#include "scenes/results/mesh_values.hpp"
#include "scenes/results/parts/elastic_release.hpp"
#include "scenes/results/parts/result_parts.hpp"
#include "scenes/results/shear_results.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Largest values of some series over all samples.
struct Peaks {
  double elastic = 0, plastic = 0, hourglass = 0;  // J
  double penetration = 0;                          // -, of a boundary edge's length
  double node_distance = 0;                        // -, of a face's size: in three dimensions
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(elastic, plastic, hourglass, penetration, node_distance);
  }
};

struct KineticSample {
  double ratio = 0;     // -, kinetic over internal energy
  double load = 0;      // as Results::load
  double internal = 0;  // J
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(ratio, load, internal);
  }
};

class Results {
 public:
  Results(const Scene& scene, const World& world);

  const std::vector<SeriesInfo>& series() const { return observables_.infos(); }
  const std::vector<FieldInfo>& fields() const { return fields_; }
  const std::vector<TableInfo>& tables() const { return tables_; }
  RunMesh mesh() const { return parts_->mesh(); }

  // One value per series. Keeps the worst energy error and ratios so far, for the summary.
  std::vector<double> sample();
  // One list per field: particles in the order of their numbers, each with its nodes or elements.
  std::vector<std::vector<double>> frame() const;
  // The same field by field, requested in order. The first ones are those of mesh_values, which `mesh` visits by number.
  using VisitMesh = std::function<void(std::size_t field, const ValueSink& take)>;
  FrameValues frame_values(VisitMesh mesh) const;

  // From the last sample.
  double value(const std::string& series) const;
  bool has(const std::string& series) const { return !last_.empty() && position_.contains(series); }
  // Along the axes, and angular about the origin: momentum_series. Internal forces of the powder conserve all three in
  // every step and not only in the limit: positions at t_n, velocities at t_(n-1/2).
  std::vector<double> momentum() const { return momentum_.read(observation()); }
  const Energies& energies() const { return energies_; }
  const Peaks& peaks() const { return peaks_; }
  // How heavily the powder is loaded. The largest force of a tool, N; in a periodic cell the magnitude of its stress, Pa;
  // without either the root of the stored energy, with which the forces between elastic bodies grow.
  double load() const;
  // Largest |balance| so far over the largest energy that was supplied or present at the start: the value reported,
  // expected and checked against `limits`, at every sample. At first contact there is hardly any energy to compare with:
  // the work of the tools in their `steps_of_a_touch` strongest steps is ignored, and so is round-off.
  double energy_balance_error() const;
  // Largest kinetic over internal energy so far, of the samples with more than a tenth of the largest load and 1% of the
  // largest internal energy so far: nothing is quasi-static at first touch. Also reported and checked.
  double kinetic_ratio() const;
  // Of the energy released on unloading; none: nothing was unloaded.
  std::optional<double> released_by_springs() const { return release_.share(); }
  // Smallest det F of any element in any step so far.
  double min_jacobian() const;
  std::int64_t elements() const { return parts_->elements(); }
  const ShearResults& shear() const { return shear_; }
  double tool_position(int tool, int axis) const;  // m
  double end_time() const { return world_.resource<Clock>().end; }

  // Stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(last_, energies_, initial_energy_, worst_balance_, largest_energy_, largest_load_,
          largest_internal_, kinetic_samples_, release_, peaks_, shear_, first_);
  }

 private:
  Observation observation() const;
  void take_energies();
  void take_kinetic_ratio();
  void take_peaks();

  const World& world_;
  std::unique_ptr<ResultParts> parts_;
  Observables observables_, momentum_;
  FrameFields frame_fields_;  // of the frames beside those of the mesh
  std::vector<TableInfo> tables_;
  std::vector<FieldInfo> fields_;
  std::vector<ParticleValues> mesh_values_;
  std::map<std::string, std::size_t> position_;
  std::vector<double> last_;
  Energies energies_;
  Peaks peaks_;
  double stiffness_energy_ = 0;  // J, largest bulk modulus times volume of the particles
  double initial_energy_ = 0, worst_balance_ = 0, largest_energy_ = 0;
  double largest_load_ = 0;
  double largest_internal_ = 0;
  std::vector<KineticSample> kinetic_samples_;  // that may be the worst
  ElasticRelease release_;
  ShearResults shear_;
  bool first_ = true;
};

}  // namespace pulvis

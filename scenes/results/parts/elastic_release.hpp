// The share of the energy released on unloading that was stored in contact springs.
//
// Springs of contacts act in series with the particles that they press. Under a common load, the energies of springs in
// series are in proportion to their compliances, so with the energies released by the elements and by the contact springs
//
//     share = contact / (elastic + contact) = compliance of the contact springs / whole compliance
//
// and the modulus of the unloading powder is (1 - share) times that between rigid contacts. Exact for linear springs.
//
// Range   Of all releases after a peak of the load, the one that released most. Less than a tenth of the largest stored
//         energy is no unloading: rearrangements and vibrations release that much
#pragma once

#include <optional>

namespace pulvis {

class ElasticRelease {
 public:
  // One sample. Load: in any unit that is the same for all samples. Energies stored at that time, J.
  void sample(double load, double elastic, double contact);
  std::optional<double> share() const;  // -; none: nothing was unloaded

  // Stored in a checkpoint.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(peak_load_, elastic_at_peak_, contact_at_peak_, elastic_, contact_, largest_stored_);
  }

 private:
  double peak_load_ = 0, elastic_at_peak_ = 0, contact_at_peak_ = 0;
  double elastic_ = 0, contact_ = 0;  // J, of the largest release
  double largest_stored_ = 0;         // J
};

}  // namespace pulvis

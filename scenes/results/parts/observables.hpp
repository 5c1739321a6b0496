// The series of a run as one table. A row says what a series is called, its unit, its label for axes, its meaning, whether
// this scene has it, and how it is read: names and values cannot get out of step. Rows of one computation form a group: the computation runs
// once per sample, each row reads its result.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"

namespace pulvis {

class ShearResults;

// Energies of the whole scene at t_n, J. `balance` is the remainder of the others: 0 in a perfect run.
struct Energies {
  double kinetic = 0, elastic = 0, plastic = 0, hourglass = 0, contact = 0, indentation = 0;
  double friction = 0, damping = 0, bulk_damping = 0, bonds = 0, fracture = 0;
  double external = 0, balance = 0;
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(kinetic, elastic, plastic, hourglass, contact, indentation, friction, damping,
          bulk_damping, bonds, fracture, external, balance);
  }
  double internal() const { return elastic + plastic + hourglass + indentation; }
};

// What the rows read at a sample.
struct Observation {
  const World& world;
  const Energies& energies;
  const ShearResults& shear;
  double powder = 0;        // of all particles, undeformed: m^2, in three dimensions m^3
  double min_jacobian = 0;  // smallest det F so far
};

// `read`: a member of the figures, or a function of them.
template <class Figures>
struct Observable {
  std::string name, unit, label, meaning;
  std::function<double(const Figures&)> read;
  bool exists = true;  // in this scene
};

class Observables {
 public:
  // `compute`: the figures of an observation, for all rows of the group.
  template <class Compute,
            class Figures = std::decay_t<std::invoke_result_t<Compute, const Observation&>>>
  void add(Compute compute, std::vector<Observable<Figures>> rows) {
    std::vector<std::function<double(const Figures&)>> reads;
    for (Observable<Figures>& row : rows) {
      if (!row.exists) continue;
      infos_.push_back(
          {std::move(row.name), std::move(row.unit), std::move(row.label), std::move(row.meaning)});
      reads.push_back(std::move(row.read));
    }
    groups_.push_back([compute = std::move(compute), reads = std::move(reads)](
                          const Observation& now, std::vector<double>& values) {
      const Figures& figures = compute(now);
      for (const auto& read : reads) values.push_back(read(figures));
    });
  }
  // Rows that read the observation itself.
  void add(std::vector<Observable<Observation>> rows) {
    add([](const Observation& now) -> const Observation& { return now; }, std::move(rows));
  }

  const std::vector<SeriesInfo>& infos() const { return infos_; }
  // One value per info, in the same order.
  std::vector<double> read(const Observation& now) const {
    std::vector<double> values;
    values.reserve(infos_.size());
    for (const auto& group : groups_) group(now, values);
    return values;
  }

 private:
  std::vector<SeriesInfo> infos_;
  std::vector<std::function<void(const Observation&, std::vector<double>&)>> groups_;
};

}  // namespace pulvis

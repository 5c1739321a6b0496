// The fields of the frames that are not those of the mesh (mesh_values.hpp), as one table like Observables: each row
// describes a field and how its values are taken.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/results/parts/observables.hpp"

namespace pulvis {

// `take`: a list among the figures, which the row may move out of them, or a function.
template <class Figures>
struct FrameField {
  FieldInfo info;
  std::function<std::vector<double>(Figures&&)> take;
  bool exists = true;  // in this scene
};

class FrameFields {
 public:
  // `compute`: the figures of a frame, for all rows of the group.
  template <class Compute,
            class Figures = std::decay_t<std::invoke_result_t<Compute, const Observation&>>>
  void add(Compute compute, std::vector<FrameField<Figures>> rows) {
    std::vector<std::function<std::vector<double>(Figures &&)>> takes;
    for (FrameField<Figures>& row : rows) {
      if (!row.exists) continue;
      infos_.push_back(std::move(row.info));
      takes.push_back(std::move(row.take));
    }
    groups_.push_back([compute = std::move(compute), takes = std::move(takes)](
                          const Observation& now, std::vector<std::vector<double>>& fields) {
      Figures figures = compute(now);
      for (const auto& take : takes) fields.push_back(take(std::move(figures)));
    });
  }
  // Rows that read the observation itself.
  void add(std::vector<FrameField<Observation>> rows) {
    add([](const Observation& now) { return now; }, std::move(rows));
  }

  const std::vector<FieldInfo>& infos() const { return infos_; }
  // One list per info, in the same order.
  std::vector<std::vector<double>> read(const Observation& now) const {
    std::vector<std::vector<double>> fields;
    fields.reserve(infos_.size());
    for (const auto& group : groups_) group(now, fields);
    return fields;
  }

 private:
  std::vector<FieldInfo> infos_;
  std::vector<std::function<void(const Observation&, std::vector<std::vector<double>>&)>> groups_;
};

}  // namespace pulvis

// What the numbers of a dataset of run.h5 are: its attributes `unit`, `meaning` and, for results, `label`.
#pragma once

#include <string>
#include <string_view>

#include "engine/files/hdf5.hpp"

namespace pulvis {

inline void describe(hdf5::File& file, const std::string& dataset, const std::string& unit,
                     const std::string& meaning, const std::string& label = "") {
  file.set_attribute(dataset, "unit", std::string_view(unit));
  if (!label.empty()) file.set_attribute(dataset, "label", std::string_view(label));
  file.set_attribute(dataset, "meaning", std::string_view(meaning));
}

}  // namespace pulvis

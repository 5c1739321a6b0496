// Source location in a scene file.
#pragma once

#include <tuple>

namespace pulvis {

// Location in a scene file, kept with every object so that errors found after reading (an overlap, a
// particle outside the die) still refer to the line that caused them.
struct SourceMark {
  int line = 0;
  int column = 0;
  int file =
      0;  // 0: the scene's own; 1: its base file, 2: the base file of that one, ...

  bool operator==(const SourceMark&) const = default;
};

// A base file comes before the file that extends it.
inline bool written_before(const SourceMark& a, const SourceMark& b) {
  return std::tuple(-a.file, a.line, a.column) < std::tuple(-b.file, b.line, b.column);
}

}  // namespace pulvis

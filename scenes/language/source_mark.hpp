// Where something is written in a scene file.
#pragma once

#include <tuple>

namespace pulvis {

// One place of a scene file, kept with every object so that errors found after reading (an overlap, a
// particle outside the die) still point at the line that caused them.
struct SourceMark {
  int line = 0;
  int column = 0;
  int file =
      0;  // 0: the scene's own; 1: the one that it extends, 2: the one that that one extends, ...

  bool operator==(const SourceMark&) const = default;
};

// What is extended comes before what extends it.
inline bool written_before(const SourceMark& a, const SourceMark& b) {
  return std::tuple(-a.file, a.line, a.column) < std::tuple(-b.file, b.line, b.column);
}

}  // namespace pulvis

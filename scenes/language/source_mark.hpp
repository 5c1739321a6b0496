// Where something is written in a scene file.
#pragma once

namespace pulvis {

// One place of a scene file, kept with every object so that errors found after reading (an overlap, a
// particle outside the die) still point at the line that caused them.
struct SourceMark {
  int line = 0;
  int column = 0;
};

}  // namespace pulvis

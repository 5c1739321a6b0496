#include "scenes/meshes/hollows.hpp"

#include <map>
#include <set>
#include <utility>

namespace pulvis {

// Sides that belong to only one element, except those of the outline.
std::vector<Hollows::Loop> hollows_of(const Shape& shape) {
  std::set<std::pair<int, int>> sides;
  for (const auto& quad : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) sides.emplace(quad[k].value, quad[(k + 1) % 4].value);
  std::map<int, int> next;
  for (const auto& [from, to] : sides)
    if (from >= shape.boundary_nodes && !sides.contains({to, from})) next[from] = to;

  std::vector<Hollows::Loop> loops;
  while (!next.empty()) {
    Hollows::Loop& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      if (loop.empty()) loop.push_back(at->first);
      loop.push_back(at->second);
      next.erase(at);
    }
    loop.pop_back();  // where it began
  }
  return loops;
}

}  // namespace pulvis

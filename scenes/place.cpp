#include "scenes/place.hpp"

#include <algorithm>

namespace pulvis {
namespace {

struct Source {  // one [[body]] or [[packing]]
  SourceMark mark;
  const BodySpec* body;
  const SquarePacking* packing;
};

std::vector<Source> sources_in_file_order(const Scene& scene) {
  std::vector<Source> sources;
  for (const BodySpec& body : scene.bodies) sources.push_back({body.mark, &body, nullptr});
  for (const SquarePacking& packing : scene.packings)
    sources.push_back({packing.mark, nullptr, &packing});
  std::stable_sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
    return std::pair(a.mark.line, a.mark.column) < std::pair(b.mark.line, b.mark.column);
  });
  return sources;
}

void add_packing(const SquarePacking& packing, std::vector<BodySpec>& bodies) {
  for (int row = 0; row < packing.rows; ++row) {
    for (int column = 0; column < packing.columns; ++column) {
      BodySpec body;
      body.particle = packing.particle;
      body.position = packing.corner + packing.spacing * Vec2(column + 0.5, row + 0.5);
      body.mark = packing.mark;
      bodies.push_back(body);
    }
  }
}

}  // namespace

std::vector<BodySpec> place_bodies(const Scene& scene) {
  std::vector<BodySpec> bodies;
  for (const Source& source : sources_in_file_order(scene)) {
    if (source.body != nullptr) bodies.push_back(*source.body);
    if (source.packing != nullptr) add_packing(*source.packing, bodies);
  }
  return bodies;
}

}  // namespace pulvis

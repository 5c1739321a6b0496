// The shares of all ranks put together on the root, and a checkpoint dealt out to them. Every function is collective.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/files/checkpoint.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"
#include "scenes/ranks/columns.hpp"

namespace pulvis {

// The world of the whole scene on the root, with the same columns as its share; null on other ranks.
class Gatherer {
 public:
  Gatherer(World& share, World* whole);

  // What changes of column number `column` (of World::columns), of a kind of entity that is divided by chunks.
  void column(std::size_t column);
  // All contact rows, in the order that one process has them in, with their index.
  void rows();
  // What all ranks have alike: tools, and resources that are not of a share. The root's own are taken.
  void common();

 private:
  void slot_rows(const char* entity, std::vector<std::int32_t>& own_begin,
                 std::vector<std::int32_t>& whole_begin);
  std::vector<std::byte> joined(std::span<const std::byte> own,
                                const std::vector<std::size_t>& bytes_of_chunk);
  void triangles(const std::vector<std::int32_t>& own_begin,
                 const std::vector<std::int32_t>& whole_begin);
  void neighbours();

  World& share_;
  World* whole_;
  Ranks& ranks_;
};

// Takes of the checkpoint what `share` holds, and finds its border. Throws BadState where it does not fit the scene.
void restore_share(const Checkpoint& checkpoint, World& share,
                   std::set<std::string> left_alone = {});

}  // namespace pulvis

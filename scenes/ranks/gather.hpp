// Gathers the shares of all ranks on the root, and distributes a checkpoint to them. Every function is collective.
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
#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

// The world of the whole scene on the root, with the same columns as its share; null on the other ranks.
class Gatherer {
 public:
  Gatherer(World& share, World* whole);

  // Column number `column` (of World::columns), of an entity divided by chunks or of contact rows; these in the
  // order of a single-process run.
  void column(std::size_t column);
  // Values of all particles by number: passed to `take`, on the root.
  void particles(const ParticleValues& values, const ValueSink& take);
  // The index of all contact rows; their pairs must have been gathered.
  void row_index();
  // What is identical on all ranks: tools, and resources that are not part of a share. Copied from the root.
  void common();

 private:
  struct RowBegins {  // first row of every slot: here, and on the root of the whole
    std::vector<std::int32_t> own, whole;
  };
  RowBegins row_begins(const std::string& entity);
  void part_of_column(std::size_t column, const RowBegins& begins, int first, int last);
  std::vector<std::byte> joined(std::span<const std::byte> own,
                                const std::vector<std::size_t>& bytes_of_chunk);
  void triangles(const RowBegins& begins);
  void neighbours();

  World& share_;
  World* whole_;
  Ranks& ranks_;
};

// Takes from the checkpoint what `share` holds, and finds its border. Throws BadState if it does not fit the scene.
void restore_share(const Checkpoint& checkpoint, World& share,
                   std::set<std::string> left_alone = {});

}  // namespace pulvis

#include "scenes/results/state_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <vector>

#include "components/bond.hpp"
#include "components/contact.hpp"
#include "components/probe.hpp"
#include "components/run_state.hpp"
#include "components/solid.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "engine/entry.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

// The bytes that the hash covers for the contacts of kind At of a particle: of each row in contact its key, number, edge
// and partner, and its history; rows sorted by key.
template <class At>
class History {
 public:
  explicit History(const World& world) : world_(world), bodies_(world.resource<Bodies>()) {}

  std::vector<std::byte> of(int slot) {
    if (!world_.has<ContactPair<At>>()) return {};
    const auto& index = world_.resource<ContactIndex>();
    const std::vector<std::int32_t>& begin = with_tools ? index.tool_begin : index.sampled_begin;
    if (begin.empty()) return {};              // nothing was searched yet
    std::vector<std::array<int, 3>> touching;  // edge, partner; row
    for (int r = entry(begin, slot); r < entry(begin, slot + 1); ++r) {
      const std::int32_t* key = world_.column<ContactPair<At>>().values() + std::ptrdiff_t{3} * r;
      if (world_.column<ContactTouches<At>>().values()[r] != 0)
        touching.push_back({key[1], with_tools ? key[2] : number_in(key[2]), r});
    }
    std::ranges::sort(touching);
    for (const auto& [edge, other, row] : touching) {
      add(std::array{number_in(slot), edge, other});
      if constexpr (std::is_same_v<At, FaceContact>) add_springs(row);
      using Bonded = std::conditional_t<At::axes == 3, space::BondedPoints<At>, BondedPoints<At>>;
      add_history<PointIndentation<At>, ElasticSlip<At>, SlipWeakening<At>, Bonded, BondDamage<At>>(
          row);
    }
    return std::move(bytes_);
  }

 private:
  static constexpr bool with_tools =
      std::is_same_v<At, ToolContact> || std::is_same_v<At, FaceToolContact>;

  template <class T>
  void add(const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  int number_in(int slot) const { return entry(bodies_.slots, slot).number; }

  void add_springs(int row) {
    using Point = space::ContactPoint;
    const double* first = world_.column<Point>().values() + std::ptrdiff_t{row} * Point::count;
    for (int g = 0; g < space::face_points; ++g)
      for (int k = Point::spring; k < Point::numbers; ++k) add(first[g * Point::numbers + k]);
  }
  template <class... Columns>
  void add_history(int row) {
    (add_points<Columns>(row), ...);
  }
  template <class C>
  void add_points(int row) {
    if (!world_.has<C>()) return;
    for (int i = 0; i < C::count; ++i)
      add(world_.column<C>().values()[std::ptrdiff_t{row} * C::count + i]);
  }

  const World& world_;
  const Bodies& bodies_;
  std::vector<std::byte> bytes_;
};

// As numbers, of which the first counts the bytes.
template <class At>
void append_history(const World& world, int slot, std::vector<double>& out) {
  const std::vector<std::byte> bytes = History<At>(world).of(slot);
  const std::size_t first = out.size();
  out.resize(first + 1 + (bytes.size() + sizeof(double) - 1) / sizeof(double));
  out[first] = static_cast<double>(bytes.size());
  std::memcpy(out.data() + first + 1, bytes.data(), bytes.size());
}
std::span<const std::byte> bytes_in(std::span<const double> numbers) {
  return std::as_bytes(numbers.subspan(1)).first(static_cast<std::size_t>(numbers.front()));
}

std::uint64_t hash_of(const World& world, const VisitHashed& visit) {
  Xxh3 hash;
  const auto add = [&](const auto& value) { hash.add(std::as_bytes(std::span(&value, 1))); };
  const Clock& clock = world.resource<Clock>();
  add(clock.step);
  for (const double time : {clock.time, clock.dt_before, clock.dt}) add(time);
  visit(0, [&](std::span<const double> state) { hash.add(std::as_bytes(state)); });
  for (std::size_t i = 1; i < hashed_values().size(); ++i)
    visit(i, [&](std::span<const double> history) { hash.add(bytes_in(history)); });
  return hash.value();
}

// For a column without lanes: its rows are in the order of the mesh.
template <class C>
void add_column(const World& world, Xxh3& hash) {
  if (!world.has<C>()) return;
  const Column<C>& column = world.column<C>();
  hash.add(std::span(column.data(), column.bytes()));
}

std::uint64_t solid_hash(const World& world) {
  Xxh3 hash;
  add_column<Displacement>(world, hash);
  add_column<AppliedForce>(world, hash);
  add_column<SolidMemory>(world, hash);
  add_column<ProbeForce>(world, hash);
  add_column<ProbeMemory>(world, hash);
  // Target, and the stiffness that was factorised: the next increment may reuse the factors.
  for (const World::SavedResource& resource : world.saved_resources()) hash.add(resource.state());
  return hash.value();
}

}  // namespace

std::vector<ParticleValues> hashed_values() {
  return {state_values(), append_history<Contact>, append_history<ToolContact>,
          append_history<FaceContact>, append_history<FaceToolContact>};
}

std::uint64_t state_hash(const World& world, const VisitHashed& visit) {
  return world.has<SolidMesh>() ? solid_hash(world) : hash_of(world, visit);
}

std::uint64_t state_hash(const World& world) {
  return state_hash(world, [&](std::size_t i, const ValueSink& take) {
    visit_all(world, hashed_values().at(i), take);
  });
}

std::string state_hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }
std::string state_hash_text(const World& world) { return state_hash_text(state_hash(world)); }

}  // namespace pulvis

#include "scenes/results/state_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "components/bond.hpp"
#include "components/contact.hpp"
#include "components/probe.hpp"
#include "components/run_state.hpp"
#include "components/solid.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

class StateHash {
 public:
  explicit StateHash(const World& world)
      : world_(world), bodies_(world.resource<Bodies>()), clock_(world.resource<Clock>()) {}

  std::uint64_t value(const VisitState& visit) {
    add(clock_.step);
    for (const double time : {clock_.time, clock_.dt_before, clock_.dt}) add(time);
    visit([this](std::span<const double> of_one) { hash_.add(std::as_bytes(of_one)); });
    const auto number = [this](int slot) { return number_in(slot); };
    const auto itself = [](int tool) { return tool; };
    add_contacts<Contact>(number, [this](int row) { add_history<Contact>(row); });
    add_contacts<ToolContact>(itself, [this](int row) { add_history<ToolContact>(row); });
    add_contacts<FaceContact>(number, [this](int row) { add_springs(row); });
    add_contacts<FaceToolContact>(itself, [this](int row) { add_slip(row); });
    return hash_.value();
  }

 private:
  template <class T>
  void add(const T& value) {
    hash_.add(std::as_bytes(std::span(&value, 1)));
  }

  int number_in(int slot) const { return bodies_.slots[static_cast<std::size_t>(slot)].number; }

  // `add_row`: adds the history of a row in contact.
  template <class At, class Partner, class AddRow>
  void add_contacts(const Partner& partner, const AddRow& add_row) {
    if (!world_.has<ContactPair<At>>()) return;
    const auto& pair = world_.column<ContactPair<At>>();
    const auto& touches = world_.column<ContactTouches<At>>();
    std::vector<std::array<int, 4>> touching;  // number, edge, partner; row
    for (std::size_t r = 0; r < pair.table.rows; ++r) {
      const std::int32_t* key = pair.values() + 3 * r;
      if (touches.values()[r] != 0)
        touching.push_back({number_in(key[0]), key[1], partner(key[2]), static_cast<int>(r)});
    }
    std::ranges::sort(touching);
    for (const auto& [number, edge, other, row] : touching) {
      add(std::array{number, edge, other});
      add_row(row);
    }
  }
  template <class At>
  void add_history(int row) {
    add_points<ElasticSlip<At>>(row);
    add_points<SlipWeakening<At>>(row);
    if (!world_.has<BondedPoints<At>>()) return;
    add(world_.column<BondedPoints<At>>().values()[row]);
    add_points<BondDamage<At>>(row);
  }
  void add_springs(int row) {
    using Point = space::ContactPoint;
    const double* first = world_.column<Point>().values() + std::ptrdiff_t{row} * Point::count;
    for (int g = 0; g < space::face_points; ++g)
      for (int k = Point::spring; k < Point::numbers; ++k) add(first[g * Point::numbers + k]);
    add_points<space::SlipWeakening<FaceContact>>(row);
    add_bonds<FaceContact>(row);
  }
  void add_slip(int row) {
    add_points<space::ElasticSlip>(row);
    add_points<space::SlipWeakening<FaceToolContact>>(row);
    add_bonds<FaceToolContact>(row);
  }
  template <class At>
  void add_bonds(int row) {
    add_points<space::BondedPoints<At>>(row);
    add_points<space::BondDamage<At>>(row);
  }
  template <class C>
  void add_points(int row) {
    if (!world_.has<C>()) return;
    for (int i = 0; i < C::count; ++i)
      add(world_.column<C>().values()[std::ptrdiff_t{row} * C::count + i]);
  }

  const World& world_;
  const Bodies& bodies_;
  const Clock& clock_;
  Xxh3 hash_;
};

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

std::uint64_t state_hash(const World& world, const VisitState& visit) {
  return world.has<SolidMesh>() ? solid_hash(world) : StateHash(world).value(visit);
}

std::uint64_t state_hash(const World& world) {
  return state_hash(world, [&](const ValueSink& take) { visit_all(world, state_values(), take); });
}

std::string state_hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }
std::string state_hash_text(const World& world) { return state_hash_text(state_hash(world)); }

}  // namespace pulvis

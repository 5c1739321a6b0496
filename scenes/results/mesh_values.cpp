#include "scenes/results/mesh_values.hpp"

#include "components/body.hpp"
#include "components/shape.hpp"
#include "scenes/results/plane_values.hpp"
#include "scenes/results/solids/space_values.hpp"

namespace pulvis {
namespace {

template <class C>
void append_where_there(const World& world, int slot, std::vector<double>& out) {
  if (!world.has<C>()) return;
  const std::int32_t* begin =
      &world.column<C>().table.chunk_begin[static_cast<std::size_t>(slot / lane_count)];
  append_rows<C>(world, slot, static_cast<std::size_t>(begin[1] - begin[0]), out);
}

template <class... Columns>
void append_all(const World& world, int slot, std::vector<double>& out) {
  (append_where_there<Columns>(world, slot, out), ...);
}

}  // namespace

std::vector<MeshField> mesh_fields(const World& world) {
  return world.has<Position<ThreeD>>() ? space::mesh_fields(world) : plane_mesh_fields(world);
}

std::vector<ParticleValues> mesh_values(const World& world) {
  std::vector<ParticleValues> all;
  for (MeshField& field : mesh_fields(world)) all.push_back(std::move(field.values));
  return all;
}

ParticleValues state_values() {
  return append_all<Position<TwoD>, Position<ThreeD>, Velocity<TwoD>, Velocity<ThreeD>,
                    CpInverse<TwoD, 1>, CpInverse<TwoD, 4>, CpInverse<ThreeD, 1>,
                    CpInverse<ThreeD, 8>, PlasticStrain<1>, PlasticStrain<4>, PlasticStrain<8>,
                    PlasticHourglass<TwoD>, PlasticHourglass<ThreeD>>;
}

void visit_all(const World& world, const ParticleValues& values, const ValueSink& take) {
  std::vector<double> of_one;
  for (const int slot : world.resource<Bodies>().slot_of_number) {
    of_one.clear();
    values(world, slot, of_one);
    take(of_one);
  }
}

}  // namespace pulvis

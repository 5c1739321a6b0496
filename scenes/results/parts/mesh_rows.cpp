#include "scenes/results/parts/mesh_rows.hpp"

#include "components/body.hpp"
#include "components/dimension.hpp"

namespace pulvis {
namespace {

template <class C>
void of_nodes(const World& world, int slot, std::vector<double>& out) {
  append_rows<C>(world, slot, places_in(world, slot, FieldPlace::node), out);
}

}  // namespace

template <class D>
std::vector<MeshField> mesh_rows(ElementReaders elements) {
  constexpr bool flat = D::axes == 2;
  std::vector<MeshField> all{
      {{"position", "m", "position $x$", "of the node", FieldPlace::node, D::axes},
       of_nodes<Position<D>>},
      {{"velocity", "m/s", "velocity $v$", "of the node, half a step later", FieldPlace::node,
        D::axes},
       of_nodes<Velocity<D>>},
      {{"effective_stress", "Pa", "effective stress $\\sigma_\\mathrm{eff}$",
        "von Mises, mean of the Gauss points", FieldPlace::cell, 1},
       std::move(elements.effective)},
      {{"pressure", "Pa", "pressure $p$", "minus the mean stress; compression > 0",
        FieldPlace::cell, 1},
       std::move(elements.pressure)},
      {{"stress", "Pa", "stress $\\sigma$",
        flat ? "Cauchy: xx yy zz xy" : "Cauchy: xx yy zz xy yz zx", FieldPlace::cell, flat ? 4 : 6},
       std::move(elements.stress)}};
  if (elements.plastic_strain)
    all.push_back({{"plastic_strain", "-", "plastic strain $\\bar\\varepsilon_p$",
                    "accumulated, mean of the Gauss points", FieldPlace::cell, 1},
                   std::move(elements.plastic_strain)});
  return all;
}

template std::vector<MeshField> mesh_rows<TwoD>(ElementReaders);
template std::vector<MeshField> mesh_rows<ThreeD>(ElementReaders);

}  // namespace pulvis

#include "scenes/spec/flow_laws.hpp"

#include <fmt/format.h>

#include "scenes/language/csv_table.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

using kernels::TabulatedHardening;

void check_point(const csv::Table& table, std::size_t i, const std::vector<double>& strain,
                 const std::vector<double>& stress) {
  const auto refuse = [&](const char* column, const std::string& message) {
    csv::refuse(table, i, csv::column_at(table, column), message);
  };
  if (i == 0 && strain[0] != 0)
    refuse("plastic_strain", fmt::format("{:g} in the first row, allowed: 0", strain[0]));
  if (i == 0 && stress[0] < 1e-3)
    refuse("stress", fmt::format("{:g} Pa, allowed: >= 0.001 Pa", stress[0]));
  if (i == 0) return;
  if (strain[i] <= strain[i - 1])
    refuse("plastic_strain",
           fmt::format("{:g} is not above that of the previous row, allowed: > {:g}", strain[i],
                       strain[i - 1]));
  if (stress[i] < stress[i - 1])
    refuse("stress", fmt::format("{:g} Pa is below that of the previous row, which would be "
                                 "softening, allowed: >= {:g} Pa",
                                 stress[i], stress[i - 1]));
}

TabulatedHardening read_hardening_table(const std::filesystem::path& file) {
  const csv::Table table = csv::read(file);
  csv::only(table, {"plastic_strain", "stress"});
  std::vector<double> strain = csv::numbers(table, csv::column_at(table, "plastic_strain"), "");
  std::vector<double> stress = csv::numbers(table, csv::column_at(table, "stress"), "Pa");
  if (strain.empty()) csv::refuse(table, "plastic_strain", "no rows, allowed: at least one");
  for (std::size_t i = 0; i < strain.size(); ++i) check_point(table, i, strain, stress);
  return {std::move(strain), std::move(stress)};
}

class Completion {
 public:
  Completion(Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void complete(std::size_t i) {
    MaterialSpec& material = scene_.materials[i];
    path_ = fmt::format("material[{}]", i);
    auto flow = std::make_shared<FlowLaw>(*material.flow);
    if (!fits(material, *flow)) return;
    if (auto* table = std::get_if<TabulatedHardening>(&flow->hardening)) {
      *table = read_hardening_table(scene_.file.parent_path() / flow->file);
      material.yield_stress = table->sigma_y;
    }
    auto* linear = std::get_if<kernels::LinearHardening<double>>(&flow->hardening);
    if (linear != nullptr) material.hardening_modulus += linear->H;  // one of them is 0
    std::visit([&](auto& law) { law.sigma_y = *material.yield_stress; }, flow->hardening);
    material.flow = flow->is_linear() ? nullptr : flow;
  }

 private:
  void refuse(const std::string& key, const std::string& message) {
    const auto found = origins_.find(origins_.contains(path_ + key) ? path_ + key : path_);
    problems_.add(found->second, path_ + key, message);
  }

  bool fits(const MaterialSpec& material, const FlowLaw& flow) {
    const bool table = std::holds_alternative<TabulatedHardening>(flow.hardening);
    const bool has_table = origins_.contains(path_ + ".hardening");
    if (table && material.yield_stress)
      refuse(".yield_stress",
             "it is given by the table of material.hardening, allowed: only one of them");
    else if (!table && !material.yield_stress)
      refuse(has_table ? ".hardening" : ".rate",
             "has no effect without yield_stress, allowed: with it");
    else if (has_table && material.hardening_modulus > 0)
      refuse(".hardening_modulus",
             "is the short form of linear hardening, which material.hardening replaces, allowed: "
             "only one of them");
    else
      return check_family(flow);
    return false;
  }

  bool check_family(const FlowLaw& flow) {
    if (!scene_.afm || flow.rate.index() == 0) return true;
    refuse(
        ".rate",
        "levers are solved statically, without rates, allowed: only with family = \"compaction\"");
    return false;
  }

  Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
  std::string path_;
};

}  // namespace

void complete_flow_laws(Scene& scene, const schema::Origins& origins, Problems& problems) {
  Completion laws(scene, origins, problems);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].flow) laws.complete(i);
}

}  // namespace pulvis

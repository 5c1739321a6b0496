#include "scenes/space/keys/tables.hpp"

namespace pulvis {

namespace space {
namespace {

schema::TableView variables_of_scenes() {
  return *schema::find_table("let", schema::scene_language());
}

}  // namespace

const schema::Language& scene_language() {
  using namespace language;
  using schema::view_of;
  static const schema::Language tables{view_of(top_level()),
                                       variables_of_scenes(),
                                       view_of(schema::material()),
                                       view_of(schema::material_damping()),
                                       view_of(schema::hardening()),
                                       view_of(schema::rate()),
                                       view_of(particle()),
                                       view_of(mesh()),
                                       view_of(body()),
                                       view_of(packing()),
                                       view_of(mixture_class()),
                                       view_of(tool()),
                                       view_of(stage()),
                                       view_of(move()),
                                       view_of(servo()),
                                       view_of(until()),
                                       view_of(schema::friction()),
                                       view_of(bond()),
                                       view_of(contact()),
                                       view_of(element()),
                                       view_of(time()),
                                       view_of(output()),
                                       view_of(schema::limits()),
                                       view_of(expect())};
  return tables;
}

}  // namespace space

bool is_in_space(const document::Table& root) {
  const document::Entry* entry = document::find(root, "dimension");
  const auto* dimension = entry == nullptr ? nullptr : entry->value.as<std::int64_t>();
  return dimension != nullptr && *dimension == 3;
}

const schema::Language& language_of(const document::Table& root) {
  return is_in_space(root) ? space::scene_language() : schema::scene_language();
}

}  // namespace pulvis

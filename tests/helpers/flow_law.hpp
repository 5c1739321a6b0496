// A flow law from the lines of its table, by the declarations of scenes.
#pragma once

#include <string>

#include "scenes/keys/tables.hpp"
#include "scenes/language/document.hpp"
#include "scenes/language/table_reader.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {

// `lines` as below [material.hardening]; what is wrong is thrown as SceneError.
inline FlowLaw hardening_of(const std::string& lines) {
  Problems problems("law.toml", {});
  const document::Table table = document::parse(lines);
  schema::TableReader reader(table, problems, schema::scene_language());
  FlowLaw law;
  reader.read(schema::hardening(), document::Value{table, {{1, 1}, -1}}, "hardening", "", law);
  problems.throw_if_any();
  return law;
}

}  // namespace pulvis

// Values that a key's declaration allows and that are not its default, the likely ones first. Which of them
// fits a scene is the reader's to say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenes/language/schema.hpp"

namespace pulvis::keys {

// `around`: the table that the key is to stand in, whose sizes tell what is large. Nothing where only a scene
// can say it: paths, names, points.
std::vector<document::Value> values_for(const schema::KeyInfo& key, const schema::TableView& view,
                                        const document::Table& around, const document::Table& root);

}  // namespace pulvis::keys

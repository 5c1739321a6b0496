#include "scenes/keys/other_dimension.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/shortened.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis {
namespace {

using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::TableView;

class OtherKeys {
 public:
  OtherKeys(int dimension, Problems& problems)
      : dimension_(dimension),
        own_(schema::scene_language(dimension)),
        other_(schema::scene_language(dimension == 2 ? 3 : 2)),
        problems_(problems) {}

  void look_through(const Table& table, const std::string& declared, const std::string& path) {
    const TableView& view = *schema::find_table(declared, own_);
    const TableView* other = schema::find_table(declared, other_);
    for (const document::Entry& entry : table) {
      const std::string at = schema::joined_path(path, entry.key);
      const std::string below = schema::joined_path(declared, entry.key);
      const KeyInfo* there = other == nullptr ? nullptr : schema::find_key(*other, entry.key);
      if (const KeyInfo* key = schema::find_key(view, entry.key)) {
        if (there != nullptr) word(*key, *there, entry.value, at);
      } else if (schema::find_table(below, own_) != nullptr) {
        look_below(entry.value, below, at);
      } else if (there != nullptr || schema::find_table(below, other_)) {
        refuse(entry.origin, at, listed(schema::known_words(view, own_)));
      }
    }
  }

 private:
  void look_below(const Value& value, const std::string& declared, const std::string& path) {
    if (const auto* table = value.as<Table>()) look_through(*table, declared, path);
    if (!document::is_array_of_tables(value)) return;
    const auto& elements = value.get<document::Array>();
    for (std::size_t i = 0; i < elements.size(); ++i)
      look_through(elements[i].get<Table>(), declared, fmt::format("{}[{}]", path, i));
  }

  void word(const KeyInfo& key, const KeyInfo& there, const Value& value, const std::string& path) {
    const auto* text = value.as<std::string>();
    if (text == nullptr || key.kind != schema::Kind::choice) return;
    const auto has = [&](const KeyInfo& info) {
      return std::ranges::find(info.choices, *text, &schema::Choice::word) != info.choices.end();
    };
    if (has(there) && !has(key))
      refuse(value.origin, path, schema::allowed(key),
             shortened(document::value_text(value)) + " ");
  }

  void refuse(const document::Origin& origin, const std::string& path, const std::string& allowed,
              const std::string& subject = "") {
    problems_.add(
        origin, path,
        dimension_ == 3
            ? fmt::format("{}exists in two dimensions only and has no meaning with dimension = 3, "
                          "allowed: {}",
                          subject, allowed)
            : fmt::format(
                  "{}exists in three dimensions only, in scenes with `dimension = 3` at the "
                  "top, allowed: {}",
                  subject, allowed));
  }

  int dimension_;
  const schema::Language& own_;
  const schema::Language& other_;
  Problems& problems_;
};

// The shape of a particle in a scene that does not say that it has three dimensions: nearly all of its keys would be wrong.
const document::Entry* solid_without_dimension(const Table& root) {
  const document::Entry* particles = document::find(root, "particle");
  if (document::find(root, "dimension") != nullptr || particles == nullptr ||
      !document::is_array_of_tables(particles->value))
    return nullptr;
  for (const Value& particle : particles->value.get<document::Array>())
    if (const document::Entry* shape = document::find(particle.get<Table>(), "shape")) return shape;
  return nullptr;
}

}  // namespace

void refuse_keys_of_other_dimension(const Table& root, Problems& problems) {
  if (const document::Entry* shape = solid_without_dimension(root)) {
    problems.add(shape->origin, "particle.shape",
                 "belongs to three dimensions, allowed: with `dimension = 3` at the top of the "
                 "scene; in two dimensions a particle has an `outline`");
    return;
  }
  const int dimension = dimension_of(root);
  const std::string* family = document::find_text(root, "family");
  if (dimension == 3 && family != nullptr && *family == "afm") {
    problems.add(
        document::find(root, "dimension")->origin, "dimension",
        "belongs to scenes of particles (family = \"compaction\"): a lever always has three "
        "dimensions, allowed: no `dimension` with family = \"afm\"");
    return;
  }
  OtherKeys(dimension, problems).look_through(root, "", "");
}

}  // namespace pulvis

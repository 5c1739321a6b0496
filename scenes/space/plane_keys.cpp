#include "scenes/space/plane_keys.hpp"
#include "engine/shortened.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/space/keys/tables.hpp"

namespace pulvis::space {
namespace {

using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::TableView;

class PlaneKeys {
 public:
  explicit PlaneKeys(Problems& problems) : problems_(problems) {}

  void look_through(const Table& table, const std::string& declared, const std::string& path) {
    const TableView& view = *schema::find_table(declared, scene_language());
    const TableView* plane = schema::find_table(declared, schema::scene_language());
    for (const document::Entry& entry : table) {
      const std::string at = schema::joined_path(path, entry.key);
      const std::string below = schema::joined_path(declared, entry.key);
      const KeyInfo* of_plane = plane == nullptr ? nullptr : schema::find_key(*plane, entry.key);
      if (const KeyInfo* key = schema::find_key(view, entry.key)) {
        if (of_plane != nullptr) word(*key, *of_plane, entry.value, at);
      } else if (schema::find_table(below, scene_language()) != nullptr) {
        look_below(entry.value, below, at);
      } else if (of_plane != nullptr || schema::find_table(below, schema::scene_language())) {
        refuse(entry.origin, at, listed(schema::known_words(view, scene_language())));
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

  void word(const KeyInfo& key, const KeyInfo& of_plane, const Value& value,
            const std::string& path) {
    const auto* text = value.as<std::string>();
    if (text == nullptr || key.kind != schema::Kind::choice) return;
    const auto has = [&](const KeyInfo& info) {
      return std::ranges::find(info.choices, *text, &schema::Choice::word) != info.choices.end();
    };
    if (has(of_plane) && !has(key))
      refuse(value.origin, path, schema::allowed(key),
             shortened(document::value_text(value)) + " ");
  }

  void refuse(const document::Origin& origin, const std::string& path, const std::string& allowed,
              const std::string& subject = "") {
    problems_.add(
        origin, path,
        fmt::format(
            "{}is for two dimensions only and has no meaning with dimension = 3, allowed: {}",
            subject, allowed));
  }

  Problems& problems_;
};

}  // namespace

void refuse_keys_of_the_plane(const Table& root, Problems& problems) {
  const std::string* family = document::find_text(root, "family");
  if (family != nullptr && *family == "afm") {
    problems.add(
        document::find(root, "dimension")->origin, "dimension",
        "belongs to scenes of particles (family = \"compaction\"): a lever always has three "
        "dimensions, allowed: no `dimension` with family = \"afm\"");
    return;
  }
  PlaneKeys(problems).look_through(root, "", "");
}

void refuse_solids_in_the_plane(const Table& root, Problems& problems) {
  const document::Entry* particles = document::find(root, "particle");
  if (document::find(root, "dimension") != nullptr || particles == nullptr ||
      !document::is_array_of_tables(particles->value))
    return;
  for (const Value& particle : particles->value.get<document::Array>()) {
    const document::Entry* shape = document::find(particle.get<Table>(), "shape");
    if (shape == nullptr) continue;
    problems.add(shape->origin, "particle.shape",
                 "belongs to three dimensions, allowed: with `dimension = 3` at the top of the "
                 "scene; in two dimensions a particle has an `outline`");
    return;
  }
}

}  // namespace pulvis::space

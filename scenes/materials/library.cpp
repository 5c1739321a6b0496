#include "scenes/materials/library.hpp"
#include "engine/shortened.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pulvis {

extern const char* const material_library_text;  // generated from library.toml

namespace {

using document::Entry;
using document::Table;
using document::Value;

constexpr std::array plastic{"yield_stress", "hardening_modulus"};

std::vector<LibraryMaterial> read_library() {
  std::vector<LibraryMaterial> materials;
  const Table root = document::parse(material_library_text);
  for (const Value& element : document::find(root, "material")->value.get<document::Array>()) {
    LibraryMaterial material;
    for (const Entry& entry : element.get<Table>()) {
      std::string* text = entry.key == "name"     ? &material.name
                          : entry.key == "title"  ? &material.title
                          : entry.key == "source" ? &material.source
                                                  : nullptr;
      if (text != nullptr)
        *text = entry.value.get<std::string>();
      else
        material.values.push_back(entry);
    }
    materials.push_back(std::move(material));
  }
  return materials;
}

class LibraryFiller {
 public:
  LibraryFiller(const Table& root, const schema::Language& language, Problems& problems)
      : view_(*schema::find_table("material", language)), problems_(problems) {
    if (const std::string* family = document::find_text(root, "family")) family_ = *family;
  }

  void fill(Table& table, const std::string& path) const {
    const Entry* entry = document::find(table, "library");
    if (entry == nullptr) return refuse_bare_name(table, path);
    const LibraryMaterial* material = chosen(entry->value, path);
    if (material == nullptr) return;
    const bool elastic = is_elastic(table, path);
    const document::Origin origin = entry->value.origin;
    std::erase_if(table, [](const Entry& e) { return e.key == "library" || e.key == "elastic"; });
    const std::size_t own = table.size();
    for (const Entry& value : material->values)
      if (is_wanted(table, value.key, elastic))
        table.push_back({value.key, origin, {value.value.data, origin}});
    if (table.size() == own)
      problems_.add(origin, path + ".library",
                    "has no effect: the material has all of these values itself, allowed: a "
                    "material without those that the library is to give");
  }

 private:
  // A material that is only named, as if its name were that of the library.
  void refuse_bare_name(const Table& table, const std::string& path) const {
    const std::string* name = document::find_text(table, "name");
    const LibraryMaterial* likely = name != nullptr ? likely_material(*name) : nullptr;
    if (table.size() != 1 || likely == nullptr) return;
    problems_.add(table.front().origin, path,
                  fmt::format("it has a name and no properties, allowed: library = \"{}\" ({}), or "
                              "density, youngs_modulus and poissons_ratio",
                              likely->name, likely->title));
  }

  const LibraryMaterial* chosen(const Value& value, const std::string& path) const {
    const auto* name = value.as<std::string>();
    std::vector<std::string> names;
    for (const LibraryMaterial& material : material_library()) {
      if (name != nullptr && material.name == *name) return &material;
      names.push_back(material.name);
    }
    problems_.add(value.origin, path + ".library",
                  fmt::format("{} is not a material of the library{}, allowed: {}",
                              shortened(document::value_text(value)),
                              name != nullptr ? hint_for(*name) : "", listed(names)));
    return nullptr;
  }

  static std::string hint_for(const std::string& name) {
    const LibraryMaterial* likely = likely_material(name);
    if (likely == nullptr) return "";
    const std::string spelling = suggestion(name, {likely->name});
    return spelling.empty() ? fmt::format(", did you mean '{}' ({})?", likely->name, likely->title)
                            : spelling;
  }

  bool is_elastic(const Table& table, const std::string& path) const {
    const Entry* entry = document::find(table, "elastic");
    if (entry == nullptr) return false;
    const bool* flag = entry->value.as<bool>();
    if (flag == nullptr)
      problems_.add(entry->value.origin, path + ".elastic",
                    fmt::format("wrong type, {} is given, allowed: true or false",
                                document::type_name(entry->value)));
    for (const char* key : plastic)
      if (const Entry* given = document::find(table, key); flag != nullptr && *flag && given)
        problems_.add(given->origin, path + "." + key,
                      "contradicts elastic = true, allowed: only one of the two");
    return flag != nullptr && *flag;
  }

  bool is_wanted(const Table& table, const std::string& key, bool elastic) const {
    const bool of_plastic = std::ranges::find(plastic, key) != plastic.end();
    const bool other_law =
        key == "hardening_modulus" && document::find(table, "hardening") != nullptr;
    return document::find(table, key) == nullptr && !(elastic && of_plastic) && !other_law &&
           schema::applies(*schema::find_key(view_, key), table, family_);
  }

  const schema::TableView& view_;
  Problems& problems_;
  std::string family_;
};

// What it is, without its form and its use: "stainless", "steel" of "stainless steel 316L, annealed".
std::vector<std::string> substances_in(std::string title) {
  constexpr std::size_t shortest = 4;
  title.resize(std::min({title.find(','), title.find(" for "), title.size()}));
  std::vector<std::string> words;
  for (std::size_t at = 0; at < title.size();) {
    const std::size_t end = std::min(title.find_first_of(" ,-", at), title.size());
    if (end - at >= shortest) words.push_back(title.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

// "cu" of "Cu-OFHC".
bool starts_like(const std::string& name, const std::string& word) {
  const auto small = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return word.size() >= 2 && word.size() <= name.size() &&
         std::ranges::equal(name.substr(0, word.size()), word, {}, small, small);
}

std::string cell_of(const LibraryMaterial& material, const char* key) {
  const Entry* entry = document::find(material.values, key);
  if (entry == nullptr) return "-";
  const auto* text = entry->value.as<std::string>();
  return text != nullptr ? *text : document::value_text(entry->value);
}

}  // namespace

const std::vector<LibraryMaterial>& material_library() {
  static const std::vector<LibraryMaterial> materials = read_library();
  return materials;
}

const LibraryMaterial* likely_material(const std::string& word) {
  constexpr std::size_t long_word = 6;  // in which a misspelling can be told from another word
  const auto meant = [&](const std::string& candidate) {
    const std::string hint = suggestion(word, {candidate});
    return !hint.empty() && (word.size() >= long_word || starts_like(candidate, word));
  };
  const std::vector<LibraryMaterial>& all = material_library();
  auto found = std::ranges::find(all, word, &LibraryMaterial::name);
  if (found == all.end())
    found = std::ranges::find_if(all, [&](const LibraryMaterial& one) {
      return std::ranges::any_of(substances_in(one.title), meant) || starts_like(one.name, word);
    });
  if (found == all.end())
    found = std::ranges::find_if(all, [&](const LibraryMaterial& one) { return meant(one.name); });
  return found == all.end() ? nullptr : &*found;
}

void fill_materials(Table& root, const schema::Language& language, Problems& problems) {
  Entry* materials = document::find(root, "material");
  if (materials == nullptr || !document::is_array_of_tables(materials->value)) return;
  const LibraryFiller filler(root, language, problems);
  auto& elements = materials->value.get<document::Array>();
  for (std::size_t i = 0; i < elements.size(); ++i)
    filler.fill(elements[i].get<Table>(), fmt::format("material[{}]", i));
}

std::string material_reference() {
  std::string text = R"md(# The library of materials

<!-- Generated from scenes/materials/library.toml: change that, not this file. -->

A scene refers to a material by its name in this library. Values given in the scene override those of the library;
`elastic = true` omits the plastic properties. A saved scene contains the values, so it is not affected by later changes
to the library.

```toml
[[material]]
name = "powder"                # what particles call it
library = "316L"
yield_stress = "280 MPa"       # instead of the library's
```

Sources are listed below. Values called typical have no specific source; they give only the order of magnitude. The
properties of a powder batch depend on manufacture, moisture and processing; measure the properties that affect your
results.

| `library` | material | density | Young's modulus | Poisson's ratio | yield stress | hardening modulus |
|---|---|---|---|---|---|---|
)md";
  for (const LibraryMaterial& material : material_library())
    text += fmt::format("| `\"{}\"` | {} | {} | {} | {} | {} | {} |\n", material.name,
                        material.title, cell_of(material, "density"),
                        cell_of(material, "youngs_modulus"), cell_of(material, "poissons_ratio"),
                        cell_of(material, "yield_stress"), cell_of(material, "hardening_modulus"));
  text +=
      "\nMaterials without a yield stress are elastic; without a hardening modulus they are "
      "perfectly plastic.\n\n## Sources\n\n";
  for (const LibraryMaterial& material : material_library())
    text += fmt::format("- **{}**: {}\n", material.name, material.source);
  return text;
}

}  // namespace pulvis

#include "scenes/language/key_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/language/problem.hpp"

namespace pulvis::schema {
namespace {

using Pair = std::pair<const char*, const char*>;

// What textbooks and other programs call a key; one symbol may stand for several.
constexpr std::array called_otherwise{Pair{"E", "youngs_modulus"},
                                      Pair{"Young", "youngs_modulus"},
                                      Pair{"young", "youngs_modulus"},
                                      Pair{"elastic_modulus", "youngs_modulus"},
                                      Pair{"modulus", "youngs_modulus"},
                                      Pair{"nu", "poissons_ratio"},
                                      Pair{"poisson", "poissons_ratio"},
                                      Pair{"rho", "density"},
                                      Pair{"sigma_y", "yield_stress"},
                                      Pair{"yield", "yield_stress"},
                                      Pair{"yield_strength", "yield_stress"},
                                      Pair{"H", "hardening_modulus"},
                                      Pair{"mu", "friction"},
                                      Pair{"mu", "coefficient"},
                                      Pair{"friction_coefficient", "friction"},
                                      Pair{"friction", "coefficient"},
                                      Pair{"d", "diameter"},
                                      Pair{"D", "diameter"},
                                      Pair{"radius", "diameter"},
                                      Pair{"r", "diameter"},
                                      Pair{"R", "diameter"},
                                      Pair{"size", "diameter"},
                                      Pair{"w", "width"},
                                      Pair{"h", "height"},
                                      Pair{"type", "kind"},
                                      Pair{"type", "shape"},
                                      Pair{"type", "outline"},
                                      Pair{"shape", "outline"},
                                      Pair{"outline", "shape"},
                                      Pair{"id", "name"},
                                      Pair{"t", "duration"},
                                      Pair{"time", "duration"},
                                      Pair{"stroke", "displacement"},
                                      Pair{"travel", "displacement"},
                                      Pair{"position", "point"},
                                      Pair{"point", "position"},
                                      Pair{"porosity", "density"},
                                      Pair{"relative_density", "density"},
                                      Pair{"n", "count"},
                                      Pair{"number", "count"}};

// The same for the words of choices.
constexpr std::array words_otherwise{
    Pair{"circle", "disc"},        Pair{"disk", "disc"},         Pair{"round", "disc"},
    Pair{"square", "rectangle"},   Pair{"ball", "sphere"},       Pair{"circle", "sphere"},
    Pair{"disc", "cylinder"},      Pair{"tablet", "cylinder"},   Pair{"compress", "compact"},
    Pair{"compaction", "compact"}, Pair{"press", "compact"},     Pair{"load", "compact"},
    Pair{"release", "unload"},     Pair{"retract", "unload"},    Pair{"ejection", "eject"},
    Pair{"relax", "settle"},       Pair{"wait", "hold"},         Pair{"hex", "hexagonal"},
    Pair{"fcc", "face-centred"},   Pair{"bcc", "body-centred"},  Pair{"wall", "plane"},
    Pair{"line", "polyline"},      Pair{"powder", "compaction"}, Pair{"lever", "afm"}};

std::string another_name(const std::string& word, const TableView& view) {
  for (const auto& [other, name] : called_otherwise)
    if (word == other && find_key(view, name) != nullptr)
      return fmt::format(", did you mean '{}'?", name);
  return "";
}

std::string header(const TableInfo& info) {
  return info.repeated ? "[[" + info.path + "]]" : "[" + info.path + "]";
}

bool share_a_family(const TableInfo& a, const TableInfo& b) {
  return std::ranges::any_of(a.families.list,
                             [&](const std::string& one) { return b.families.has(one); });
}

bool is_a_table(const document::Value& value) {
  return value.as<document::Table>() != nullptr || document::is_array_of_tables(value);
}

// "[[material]] or [[packing]]": the tables that declare the key.
std::string tables_with(const std::string& key, const TableView& except, const Language& language) {
  constexpr std::size_t most = 3;  // more say nothing
  std::vector<std::string> headers;
  for (const TableView& table : language)
    if (!table.info.path.empty() && table.info.path != "let" && &table != &except &&
        share_a_family(table.info, except.info) && find_key(table, key) != nullptr)
      headers.push_back(header(table.info));
  if (headers.empty() || headers.size() > most) return "";
  return fmt::format("{}", fmt::join(headers, " or "));
}

// "[contact]" for the table of that name, wherever it is.
std::string table_called(const std::string& word, const TableView& except,
                         const Language& language) {
  for (const TableView& table : language)
    if (table.info.path.substr(table.info.path.rfind('.') + 1) == word &&
        share_a_family(table.info, except.info))
      return header(table.info);
  return "";
}

std::string place_of_table(const std::string& word, const TableView& view,
                           const Language& language) {
  const std::string named = table_called(word, view, language);
  if (named.empty()) return "";
  if (named.find('.') != std::string::npos)
    return fmt::format(": '{}' belongs into another table, as {}", word, named);
  return fmt::format(": '{}' belongs to the top level, as {}{}", word, named,
                     named[1] == '[' ? "" : " or before the first [...] or [[...]]");
}

std::string place_of_key(const std::string& word, const TableView& view, const Language& language) {
  if (!view.info.path.empty() && find_key(language.front(), word) != nullptr)
    return fmt::format(
        ": '{}' belongs to the top level, where every key is written before the first [...] or "
        "[[...]]",
        word);
  const std::string tables = tables_with(word, view, language);
  return tables.empty() ? "" : fmt::format(": '{}' belongs into {}", word, tables);
}

}  // namespace

std::string hint_of_unknown(const document::Entry& entry, const TableView& view,
                            const Language& language) {
  if (std::string name = another_name(entry.key, view); !name.empty()) return name;
  std::string place = is_a_table(entry.value) ? place_of_table(entry.key, view, language)
                                              : place_of_key(entry.key, view, language);
  if (!place.empty()) return place;
  return suggestion(entry.key, known_words(view, language));
}

std::string hint_of_word(const std::string& word, const std::vector<std::string>& words) {
  for (const auto& [other, meant] : words_otherwise)
    if (word == other && std::ranges::find(words, meant) != words.end())
      return fmt::format(", did you mean '{}'?", meant);
  return suggestion(word, words);
}

std::string hint_of_value(const document::Entry& entry, const TableView& table,
                          const Language& language) {
  if (is_a_table(entry.value)) return "";
  const std::string tables = tables_with(entry.key, table, language);
  return tables.empty() ? "" : fmt::format("; as one value it belongs into {}", tables);
}

}  // namespace pulvis::schema

#include "scenes/language/schema.hpp"

#include "scenes/language/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pulvis::schema {
namespace {

std::string range_text(const Range& range) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  std::string text;
  if (low) text += fmt::format(", {} {:g}", range.without_low ? ">" : ">=", range.low);
  if (high)
    text +=
        fmt::format("{} {} {:g}", low ? " and" : ",", range.without_high ? "<" : "<=", range.high);
  return text;
}

std::string quoted_words(const std::vector<Choice>& choices) {
  std::vector<std::string> words;
  for (const Choice& choice : choices) words.push_back('"' + choice.word + '"');
  return listed(words);
}

std::string integer_text(const KeyInfo& key) {
  const std::string multiple =
      key.multiple_of > 1 ? fmt::format(", a multiple of {}", key.multiple_of) : "";
  return "a whole number" + range_text(key.range) + multiple;
}

// For 2, 3, or as many components as the scene has dimensions.
const char* of_components(const KeyInfo& key, const char* two, const char* three,
                          const char* both) {
  return key.components == 3 ? three : key.components == 2 ? two : both;
}
std::string number_word(const KeyInfo& key) {
  return of_components(key, "two", "three", "two or three");
}
std::string axes(const KeyInfo& key) {
  return of_components(key, "[x, y]", "[x, y, z]", "[x, y] or [x, y, z]");
}
std::string last_axis(const KeyInfo& key) { return of_components(key, "y", "z", "the last"); }

bool is_child(const TableInfo& info, const std::string& parent) {
  const auto dot = info.path.rfind('.');
  const std::string owner = dot == std::string::npos ? "" : info.path.substr(0, dot);
  return !info.path.empty() && owner == parent;
}

std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// Copies a default into the tree at `origin`, i.e. the location of its table.
document::Value placed(document::Value value, const document::Origin& origin) {
  value.origin = origin;
  if (auto* array = value.as<document::Array>())
    for (document::Value& element : *array) element.origin = origin;
  return value;
}

void fill(document::Value& value, const TableView& view, const std::string& parent_selected,
          const Language& language);

void fill_child(document::Table& table, const document::Origin& origin, const TableInfo& child,
                const std::string& selected, const Language& language) {
  const std::string key = last_word(child.path);
  document::Entry* entry = document::find(table, key);
  const TableView& view = *find_table(child.path, language);
  if (entry == nullptr && (child.repeated || child.optional)) return;
  if (entry == nullptr) {
    table.push_back({key, origin, {document::Table{}, origin}});
    entry = &table.back();
  }
  if (entry->value.as<document::Table>() != nullptr && !child.repeated)
    fill(entry->value, view, selected, language);
  if (document::is_array_of_tables(entry->value) && child.repeated)
    for (document::Value& element : entry->value.get<document::Array>())
      fill(element, view, selected, language);
}

void fill(document::Value& value, const TableView& view, const std::string& parent_selected,
          const Language& language) {
  auto& table = value.get<document::Table>();
  const document::Origin origin = value.origin;
  const std::string selected = selected_by(view.info, table, parent_selected);
  for (const KeyInfo& key : view.keys) {
    const bool wanted = key.fallback && applies(key, table, selected);
    if (wanted && document::find(table, key.name) == nullptr)
      table.push_back({key.name, origin, placed(*key.fallback, origin)});
  }
  for (const TableView& child : language) {
    if (!is_child(child.info, view.info.path)) continue;
    if (view.info.path.empty() && !belongs(child.info, selected)) continue;
    const bool shared = child.info.selector == view.info.selector;
    fill_child(table, origin, child.info, shared ? selected : "", language);
  }
}

// ---- the part of one dimension ---------------------------------------------------------------------
bool exists_in(Dimension where, int dimension) {
  return where == Dimension::every || (where == Dimension::three) == (dimension == 3);
}

bool has_components(Kind kind) {
  return kind == Kind::vector || kind == Kind::points || kind == Kind::direction ||
         kind == Kind::counts;
}

// Words keep the numbers that setters know them by.
void leave_out_words(std::vector<Choice>& choices, int dimension) {
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (choices[i].index < 0) choices[i].index = static_cast<int>(i);
  std::erase_if(choices,
                [&](const Choice& choice) { return !exists_in(choice.dimension, dimension); });
}

// The default of a vector is declared with one component, which stands for all.
void repeat_component(std::optional<document::Value>& fallback, int components) {
  auto* array = fallback ? fallback->as<document::Array>() : nullptr;
  if (array == nullptr || array->size() != 1) return;
  const document::Value component = array->front();
  array->resize(static_cast<std::size_t>(components), component);
}

void take_what_differs(KeyInfo& key) {
  if (!key.in_3d.doc.empty()) key.doc = key.in_3d.doc;
  if (!key.in_3d.fallback_doc.empty()) key.fallback_doc = key.in_3d.fallback_doc;
  if (key.in_3d.range) key.range = *key.in_3d.range;
  if (key.in_3d.required) key.required = true;
}

// Values of the selector that exist in the other dimension only, and keys that exist only with them.
void leave_out_selected(TableView& view, const KeyInfo& selector, int dimension) {
  const auto is_missing = [&](const std::string& word) {
    const auto choice = std::ranges::find(selector.choices, word, &Choice::word);
    return choice != selector.choices.end() && !exists_in(choice->dimension, dimension);
  };
  std::erase_if(view.keys, [&](KeyInfo& key) {
    const bool for_some = !key.only_for.empty();
    std::erase_if(key.only_for.list, is_missing);
    std::erase_if(key.optional_for.list, is_missing);
    return for_some && key.only_for.empty();
  });
}

KeyInfo key_in(KeyInfo key, int dimension) {
  if (dimension == 3) take_what_differs(key);
  leave_out_words(key.choices, dimension);
  if (has_components(key.kind) && key.components == 0) {
    key.components = dimension;
    repeat_component(key.fallback, dimension);
  }
  return key;
}

}  // namespace

TableView in_dimension(TableView view, int dimension) {
  if (dimension == 3 && !view.info.doc_3d.empty()) view.info.doc = view.info.doc_3d;
  if (dimension == 3 && !view.info.selector_3d.empty()) view.info.selector = view.info.selector_3d;
  if (const KeyInfo* selector = find_key(view, view.info.selector))
    leave_out_selected(view, KeyInfo(*selector), dimension);
  std::erase_if(view.keys,
                [&](const KeyInfo& key) { return !exists_in(key.dimension, dimension); });
  for (KeyInfo& key : view.keys) key = key_in(std::move(key), dimension);
  return view;
}

Language in_dimension(const Language& language, int dimension) {
  Language result;
  for (const TableView& view : language) {
    const bool of_lever = view.info.families.list == afm_only.list;  // its scenes have no dimension
    if (exists_in(view.info.dimension, dimension) && !(of_lever && dimension == 3))
      result.push_back(in_dimension(view, dimension));
  }
  return result;
}

bool Range::holds(double value) const {
  const bool above_low = without_low ? value > low : value >= low;
  const bool below_high = without_high ? value < high : value <= high;
  return above_low && below_high;
}

const TableView* find_table(const std::string& path, const Language& language) {
  const auto found = std::find_if(language.begin(), language.end(),
                                  [&](const TableView& table) { return table.info.path == path; });
  return found == language.end() ? nullptr : &*found;
}

bool belongs(const TableInfo& info, const std::string& family) {
  return info.path.empty() || !every_family.has(family) || info.families.has(family);
}

const KeyInfo* find_key(const TableView& table, const std::string& name) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const KeyInfo& key) { return key.name == name; });
  return found == table.keys.end() ? nullptr : &*found;
}

std::string joined_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::vector<std::string> known_words(const TableView& table, const Language& language) {
  std::vector<std::string> words;
  for (const KeyInfo& key : table.keys) words.push_back(key.name);
  for (const TableView& child : language)
    if (is_child(child.info, table.info.path)) words.push_back(last_word(child.info.path));
  return words;
}

std::string quoted(const Words& words) {
  std::string text;
  for (std::size_t i = 0; i < words.list.size(); ++i)
    text += fmt::format("{}\"{}\"",
                        i == 0                      ? ""
                        : i + 1 < words.list.size() ? ", "
                                                    : " or ",
                        words.list[i]);
  return text;
}

std::string allowed(const KeyInfo& key) {
  const std::string quantity = fmt::format("in {}{}", key.unit, range_text(key.range));
  switch (key.kind) {
    case Kind::quantity:
      return "a quantity " + quantity;
    case Kind::vector:
      return fmt::format("{} quantities {} {}", number_word(key), axes(key), quantity) +
             (key.choices.empty()
                  ? ""
                  : fmt::format("; for {} also {}", last_axis(key), quoted_words(key.choices)));
    case Kind::points:
      return fmt::format("at least two points [{0}, {0}, ...] {1}",
                         of_components(key, "[x, y]", "[x, y, z]", "[x, y(, z)]"), quantity);
    case Kind::phase:
      return fmt::format("\"{}\" or a quantity {}", key.word, quantity);
    case Kind::number:
      return (key.choices.empty() ? "" : quoted_words(key.choices) + ", or ") + "a number" +
             range_text(key.range);
    case Kind::integer:
      return integer_text(key);
    case Kind::counts:
      return number_word(key) + " whole numbers" + range_text(key.range);
    case Kind::flag:
      return "true or false";
    case Kind::direction:
      return fmt::format("{} numbers {}, not {} 0", number_word(key), axes(key),
                         of_components(key, "both", "all", "all"));
    case Kind::text:
      return "a string of at most 200 characters on one line";
    case Kind::name:
      return "a string of 1 to 64 letters, digits, '_', '-', '+' or '.'";
    case Kind::choice:
      return quoted_words(key.choices);
    case Kind::reference:
      return "the name of a " + key.refers_to;
    case Kind::name_pair:
      return "two names, each of a material or a tool";
    case Kind::bound:
      return "a number in the SI unit of the series, or a quantity in any unit of its dimension";
    case Kind::texts:
      return "one or more strings [\"a\", \"b\", ...]";
    case Kind::integers:
      return "one or more whole numbers [1, 2, ...]" + range_text(key.range);
    case Kind::numbers:
      return "one or more numbers [0.1, 0.2, ...]" + range_text(key.range);
    case Kind::file:
    case Kind::scene:
      return "a path of at most 1000 characters on one line";
  }
  return "";
}

bool applies(const KeyInfo& key, const document::Table& table, const std::string& selected) {
  const bool has_company = key.needs.empty() || document::find(table, key.needs) != nullptr;
  return has_company && (key.only_for.empty() || key.only_for.has(selected));
}

bool is_required(const KeyInfo& key, const std::string& selected) {
  return key.required && !key.optional_for.has(selected);
}

std::string selected_by(const TableInfo& info, const document::Table& table,
                        const std::string& parent) {
  if (info.selector.empty()) return "";
  const std::string* own = document::find_text(table, info.selector);
  return own != nullptr ? *own : parent;
}

void fill_defaults(document::Table& root, const Language& language) {
  document::Value top{std::move(root), {{1, 1}, -1}};
  fill(top, language.front(), "", language);
  root = std::move(top.get<document::Table>());
}

}  // namespace pulvis::schema

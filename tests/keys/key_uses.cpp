#include "key_uses.hpp"

#include <fmt/format.h>

#include <charconv>

namespace pulvis::keys {
namespace {

using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::TableView;

std::vector<std::string> words_of(const KeyInfo& key) {
  std::vector<std::string> words;
  for (const schema::Choice& choice : key.choices) words.push_back(choice.word);
  if (!key.word.empty()) words.push_back(key.word);
  return words;
}

bool is_default(const KeyInfo& key, const Value& value) {
  return key.fallback && document::value_text(*key.fallback) == document::value_text(value);
}

// The words in a value: it is one, or has one as an element.
void add_words(const TableView& view, const KeyInfo& key, const Value& value, Uses& uses) {
  if (const auto* array = value.as<document::Array>())
    for (const Value& element : *array) add_words(view, key, element, uses);
  const auto* text = value.as<std::string>();
  for (const std::string& word : words_of(key))
    if (text != nullptr && *text == word) uses.insert({view.info.path, key.name, word});
}

void look_through(const Table& table, const TableView& view, const schema::Language& language,
                  Uses& uses) {
  for (const document::Entry& entry : table) {
    if (const KeyInfo* key = schema::find_key(view, entry.key)) {
      if (is_default(*key, entry.value)) continue;
      uses.insert({view.info.path, key->name, ""});
      add_words(view, *key, entry.value, uses);
      continue;
    }
    const TableView* child =
        schema::find_table(schema::joined_path(view.info.path, entry.key), language);
    if (child == nullptr) continue;
    if (const auto* inner = entry.value.as<Table>()) look_through(*inner, *child, language, uses);
    if (document::is_array_of_tables(entry.value))
      for (const Value& element : entry.value.get<document::Array>())
        look_through(element.get<Table>(), *child, language, uses);
  }
}

std::string key_text(const std::string& key) {
  const bool bare = key.find_first_not_of(
                        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                        "0123456789_-") == std::string::npos;
  return bare && !key.empty() ? key : document::value_text({key, {}});
}

std::string inline_text(const Value& value) {
  std::string text;
  if (const auto* table = value.as<Table>()) {
    for (const document::Entry& entry : *table)
      text += (text.empty() ? "" : ", ") + key_text(entry.key) + " = " + inline_text(entry.value);
    return "{" + text + "}";
  }
  if (!document::is_array_of_tables(value)) return document::value_text(value);
  for (const Value& element : value.get<document::Array>())
    text += (text.empty() ? "\n  " : ",\n  ") + inline_text(element);
  return "[" + text + "\n]";
}

}  // namespace

std::string Use::text() const {
  const std::string name = schema::joined_path(table, key);
  return word.empty() ? name : fmt::format("{} = \"{}\"", name, word);
}

Uses all_uses(const schema::Language& language) {
  Uses uses;
  for (const TableView& view : language)
    for (const KeyInfo& key : view.keys) {
      uses.insert({view.info.path, key.name, ""});
      for (const std::string& word : words_of(key))
        if (!is_default(key, {word, {}})) uses.insert({view.info.path, key.name, word});
    }
  return uses;
}

Uses uses_in(const Table& root, const schema::Language& language) {
  Uses uses;
  look_through(root, language.front(), language, uses);
  return uses;
}

std::vector<std::string> places_of(const std::string& table, const Table& root,
                                   const schema::Language& language) {
  if (table.empty()) return {""};
  const auto dot = table.rfind('.');
  const std::string key = table.substr(dot == std::string::npos ? 0 : dot + 1);
  const schema::TableInfo& info = schema::find_table(table, language)->info;
  std::vector<std::string> places;
  for (const std::string& parent :
       places_of(dot == std::string::npos ? "" : table.substr(0, dot), root, language)) {
    const Table* above = table_at(root, parent);
    const document::Entry* entry = above == nullptr ? nullptr : document::find(*above, key);
    const std::string place = schema::joined_path(parent, key);
    if (!info.repeated && (entry != nullptr || !info.optional)) places.push_back(place);
    if (info.repeated && entry != nullptr && document::is_array_of_tables(entry->value))
      for (std::size_t i = 0; i < entry->value.get<document::Array>().size(); ++i)
        places.push_back(fmt::format("{}[{}]", place, i));
  }
  return places;
}

const Table* table_at(const Table& root, const std::string& place) {
  if (place.empty()) return &root;
  const std::string step = place.substr(0, place.find('.'));
  const auto bracket = step.find('[');
  const document::Entry* entry = document::find(root, step.substr(0, bracket));
  if (entry == nullptr) return nullptr;
  const Value* value = &entry->value;
  if (bracket != std::string::npos) {
    std::size_t i = 0;
    std::from_chars(step.data() + bracket + 1, step.data() + step.size(), i);
    value = &value->get<document::Array>().at(i);
  }
  const auto* table = value->as<Table>();
  if (table == nullptr || step.size() == place.size()) return table;
  return table_at(*table, place.substr(step.size() + 1));
}

std::string toml_of(const Table& root) {
  std::string text;
  for (const document::Entry& entry : root)
    text += key_text(entry.key) + " = " + inline_text(entry.value) + "\n";
  return text;
}

}  // namespace pulvis::keys

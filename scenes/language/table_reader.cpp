#include "scenes/language/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/shortened.hpp"
#include "scenes/language/key_hint.hpp"

namespace pulvis::schema {

TableReader::TableReader(const document::Table& root, Problems& problems, const Language& language)
    : problems_(problems), language_(language) {
  collect_names(root);
}

// Names are collected before anything is read, so that one bad table does not make every reference
// to it look wrong.
void TableReader::collect_names(const document::Table& root) {
  for (const TableView& view : language_) {
    if (!view.info.repeated || find_key(view, "name") == nullptr) continue;
    const document::Entry* entry = document::find(root, view.info.path);
    if (entry != nullptr && !document::is_array_of_tables(entry->value)) continue;  // refused later
    names_[view.info.path];
    if (entry == nullptr) continue;
    const auto& array = entry->value.get<document::Array>();
    for (std::size_t i = 0; i < array.size(); ++i)
      collect_name(view.info.path, array[i], fmt::format("{}[{}].name", view.info.path, i));
  }
}

// Friction pairs may name materials or tools, so the two share one list.
void TableReader::collect_name(const std::string& table, const document::Value& element,
                               const std::string& path) {
  const auto& keys = element.get<document::Table>();
  const std::string* name = document::find_text(keys, "name");
  std::vector<std::string>& own = names_[table];
  if (name == nullptr || name->empty()) {
    own.emplace_back();
    return;
  }
  const auto taken = [&](const std::string& other) {
    const auto names = names_.find(other);
    return names != names_.end() && std::ranges::find(names->second, *name) != names->second.end();
  };
  const document::Origin origin = document::find(keys, "name")->value.origin;
  if (taken(table))
    problems_.add(origin, path,
                  fmt::format("'{}' is the name of another {}, allowed: each name once",
                              shortened(*name), table));
  else if (table == "tool" && taken("material"))
    problems_.add(origin, path,
                  fmt::format("'{}' is the name of a material, allowed: a name that differs from "
                              "those of all materials, for the friction pairs",
                              shortened(*name)));
  own.push_back(*name);
  const std::string* shape = document::find_text(keys, "shape");
  if (table == "tool" && shape != nullptr && *shape == "constraint")
    names_[without_contact].push_back(*name);
}

const document::Array& TableReader::elements(const document::Table& parent,
                                             const std::string& parent_path,
                                             const TableInfo& info) {
  static const document::Array none;
  const std::string key = info.path.substr(info.path.rfind('.') + 1);
  const document::Entry* entry = document::find(parent, key);
  if (entry == nullptr) return none;
  if (document::is_array_of_tables(entry->value)) return entry->value.get<document::Array>();
  problems_.add(entry->origin, joined_path(parent_path, key),
                fmt::format("wrong type, {} is given, allowed: [[{}]], once for each{}",
                            document::type_name(entry->value), info.path,
                            hint_of_value(*entry, *find_table(info.path, language_), language_)));
  return none;
}

bool TableReader::begin(const TableInfo& info, const document::Value& value,
                        const std::string& path, const std::string& parent_selected) {
  const auto* keys = value.as<document::Table>();
  if (keys == nullptr) {
    problems_.add(value.origin, path,
                  fmt::format("wrong type, {} is given, allowed: one table, [{}]",
                              document::type_name(value), info.path));
    return false;
  }
  table_ = &value;
  view_ = find_table(info.path, language_);
  path_ = path;
  selected_ = selected_by(info, *keys, parent_selected);
  origins_[path_] = value.origin;
  for (const document::Entry& entry : *keys) refuse_unknown(entry, *view_);
  return true;
}

void TableReader::refuse_unknown(const document::Entry& entry, const TableView& view) {
  const std::vector<std::string> words = known_words(view, language_);
  const TableView* table = view.info.path.empty() ? find_table(entry.key, language_) : nullptr;
  if (table != nullptr && !belongs(table->info, selected_)) {
    problems_.add(entry.origin, entry.key,
                  fmt::format("has no meaning with family = \"{}\", allowed: only with {}",
                              shortened(selected_), quoted(table->info.families)));
    return;
  }
  if (std::find(words.begin(), words.end(), entry.key) != words.end()) return;
  const auto renamed = std::ranges::find(view.keys, entry.key, &KeyInfo::formerly);
  if (renamed != view.keys.end()) {
    problems_.add(entry.origin, joined_path(path_, entry.key),
                  fmt::format("is called '{0}' now, allowed: {0}", renamed->name));
    return;
  }
  const bool is_table =
      entry.value.as<document::Table>() != nullptr || document::is_array_of_tables(entry.value);
  problems_.add(entry.origin, joined_path(path_, entry.key),
                fmt::format("unknown {}{}, allowed: {}", is_table ? "table" : "key",
                            hint_of_unknown(entry, view, language_), listed(words)));
}

std::optional<Decoded> TableReader::value_of(const KeyInfo& key) {
  const auto& keys = table_->get<document::Table>();
  const document::Entry* entry = document::find(keys, key.name);
  const bool meant = applies(key, keys, selected_);
  if (entry == nullptr && meant && is_required(key, selected_) &&
      (key.formerly.empty() || document::find(keys, key.formerly) == nullptr))
    missing(key);
  if (entry != nullptr && !meant) without_effect(key, *entry);
  if (entry == nullptr || !meant) return std::nullopt;
  const std::string path = joined_path(path_, key.name);
  origins_[path] = entry->value.origin;
  try {
    return decode(key, entry->value, names_);
  } catch (const Refusal& refusal) {
    const auto* text = entry->value.as<std::string>();
    const bool explained = key.kind == Kind::reference && text != nullptr && explain_;
    problems_.add(refusal.origin, path,
                  refusal.what() + (explained ? explain_(key.refers_to, *text) : std::string()));
    return std::nullopt;
  }
}

void TableReader::missing(const KeyInfo& key) {
  problems_.add(table_->origin, joined_path(path_, key.name),
                fmt::format("required key is missing, allowed: {}", allowed(key)));
}

// False for a misspelt one.
bool TableReader::is_choice_of_selector(const std::string& word) const {
  const KeyInfo* selector = find_key(*view_, view_->info.selector);
  return selector == nullptr || selector->choices.empty() ||
         std::ranges::find(selector->choices, word, &Choice::word) != selector->choices.end();
}

void TableReader::without_effect(const KeyInfo& key, const document::Entry& entry) {
  const std::string path = joined_path(path_, key.name);
  if (!key.only_for.empty() && !key.only_for.has(selected_)) {
    if (selected_.empty() || !is_choice_of_selector(selected_)) return;  // reported already
    problems_.add(entry.origin, path,
                  fmt::format("has no effect with {} = \"{}\", allowed: only with {}",
                              view_->info.selector, shortened(selected_), quoted(key.only_for)));
    return;
  }
  problems_.add(
      entry.origin, path,
      fmt::format("has no effect without {0}, allowed: only together with {0}", key.needs));
}

}  // namespace pulvis::schema

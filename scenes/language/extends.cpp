#include "scenes/language/extends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "engine/files/input_file.hpp"
#include "scenes/language/decode.hpp"
#include "scenes/language/named_files.hpp"
#include "scenes/language/override.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using document::Array;
using document::Entry;
using document::Table;
using document::Value;

constexpr std::size_t max_files = 8;  // in one chain; two or three are readable

void stamp(Value& value, int file);

void stamp(Table& table, int file) {
  for (Entry& entry : table) {
    entry.origin.mark.file = file;
    stamp(entry.value, file);
  }
}

void stamp(Value& value, int file) {
  value.origin.mark.file = file;
  if (auto* table = value.as<Table>()) stamp(*table, file);
  if (auto* array = value.as<Array>())
    for (Value& element : *array) stamp(element, file);
}

// The key that identifies the elements of a repeated table; empty if there is none.
std::string matched_by(const std::string& path, const schema::Language& language) {
  const schema::TableView* view = schema::find_table(path, language);
  if (view == nullptr || !view->info.repeated) return "";
  for (const char* key : {"name", "tool"})
    if (schema::find_key(*view, key) != nullptr) return key;
  return "";
}

// The key that every whole element of a repeated table without names has, such as the `kind` of a packing; empty if
// there is none.
std::string mark_of_whole(const std::string& path, const schema::Language& language) {
  const schema::TableView* view = schema::find_table(path, language);
  if (view == nullptr || !view->info.repeated || view->info.selector.empty()) return "";
  const schema::KeyInfo* selector = schema::find_key(*view, view->info.selector);
  return selector != nullptr && selector->required ? selector->name : "";
}

class Merge {
 public:
  Merge(const schema::Language& language, Problems& problems)
      : language_(language), problems_(problems) {}

  void tables(Table& base, Table&& extending, const std::string& path) const {
    std::map<std::string, std::size_t> known;  // a [let] may have thousands
    for (std::size_t i = 0; i < base.size(); ++i) known.emplace(base[i].key, i);
    for (Entry& entry : extending) {
      const auto old = known.find(entry.key);
      if (old == known.end())
        base.push_back(std::move(entry));
      else
        entries(base[old->second], std::move(entry), schema::joined_path(path, entry.key));
    }
  }

 private:
  void entries(Entry& base, Entry&& extending, const std::string& path) const {
    if (are_changes(base.value, extending.value, path))
      return changes(base, std::move(extending), path);
    const std::string key = matched_by(path, language_);
    const bool are_tables =
        base.value.as<Table>() != nullptr && extending.value.as<Table>() != nullptr;
    const bool are_elements = !key.empty() && document::is_array_of_tables(base.value) &&
                              document::is_array_of_tables(extending.value);
    if (!are_tables && !are_elements) {
      base = std::move(extending);
      return;
    }
    base.origin = extending.origin;
    if (are_tables) values(base.value, std::move(extending.value), path);
    if (are_elements)
      elements(base.value.get<Array>(), std::move(extending.value.get<Array>()), path, key);
  }

  // Elements without names replace those of the extended file, unless none of them is whole.
  bool are_changes(const Value& base, const Value& extending, const std::string& path) const {
    const std::string whole = mark_of_whole(path, language_);
    return !whole.empty() && matched_by(path, language_).empty() &&
           document::is_array_of_tables(base) && document::is_array_of_tables(extending) &&
           std::ranges::none_of(extending.get<Array>(), [&](const Value& element) {
             return document::find(element.get<Table>(), whole) != nullptr;
           });
  }

  // By position.
  void changes(Entry& base, Entry&& extending, const std::string& path) const {
    auto& own = base.value.get<Array>();
    auto& given = extending.value.get<Array>();
    if (given.size() != own.size()) {
      const std::string whole = mark_of_whole(path, language_);
      problems_.add(
          given.front().origin, path + "[0]",
          fmt::format("without `{0}` it changes the element at its position of the "
                      "extended file, which has {1}, but {2} given here, allowed: {1}, "
                      "where an empty [[{3}]] changes nothing, or `{0}` in each to "
                      "replace all of them",
                      whole, own.size(),
                      given.size() == 1 ? "1 is" : fmt::format("{} are", given.size()), path));
      return;
    }
    base.origin = extending.origin;
    for (std::size_t i = 0; i < own.size(); ++i) values(own[i], std::move(given[i]), path);
  }

  // Errors in the table as a whole are reported where it was last changed.
  void values(Value& base, Value&& extending, const std::string& path) const {
    base.origin = extending.origin;
    tables(base.get<Table>(), std::move(extending.get<Table>()), path);
  }

  // Each element of the base is matched once: a repeated name is kept for the reader to refuse.
  void elements(Array& base, Array&& extending, const std::string& path,
                const std::string& key) const {
    std::vector<bool> open(base.size(), true);
    for (Value& element : extending) {
      const std::string* name = document::find_text(element.get<Table>(), key);
      std::size_t at = 0;
      while (at < open.size() && !(open[at] && name != nullptr && is_called(base[at], key, *name)))
        ++at;
      if (at < open.size()) {
        open[at] = false;
        values(base[at], std::move(element), path);
      } else {
        base.push_back(std::move(element));
      }
    }
  }

  static bool is_called(const Value& element, const std::string& key, const std::string& name) {
    const std::string* own = document::find_text(element.get<Table>(), key);
    return own != nullptr && *own == name;
  }

  const schema::Language& language_;
  Problems& problems_;
};

class Chain {
 public:
  Chain(const schema::Language& language, Problems& problems)
      : language_(language), problems_(problems) {}

  Table whole(const std::string& text, const fs::path& file) {
    Table root = parsed(text, static_cast<int>(files_.size()));
    files_.push_back(file);
    const Entry* extends = document::find(root, "extends");
    if (extends == nullptr) return root;
    const Value given = extends->value;
    const fs::path base_path = path_of(given);
    Table base =
        whole(base_text(given, file.parent_path() / base_path), file.parent_path() / base_path);
    for_each_path(base, language_, [&](schema::Kind, std::string& path) {
      path = (base_path.parent_path() / path).string();
    });
    require_one_family(base, root);
    take_out(base, root);
    Merge(language_, problems_).tables(base, std::move(root), "");
    return base;
  }

 private:
  [[noreturn]] void refuse(const document::Origin& where, const std::string& key,
                           const std::string& message) {
    problems_.add(where, key, message);
    problems_.throw_if_any();
    throw std::logic_error("a problem was noted");  // never reached
  }

  Table parsed(const std::string& text, int file) {
    try {
      Table root = document::parse(text);
      stamp(root, file);
      if (root.empty()) refuse({{1, 1, file}, -1}, "scene", "is empty, allowed: a scene (TOML)");
      return root;
    } catch (const document::SyntaxError& error) {
      refuse({{error.mark.line, error.mark.column, file}, -1}, "syntax", error.what());
    }
  }

  const schema::KeyInfo& key_of(const std::string& name) const {
    return *schema::find_key(language_.front(), name);
  }

  fs::path path_of(const Value& given) {
    try {
      return schema::decode(key_of("extends"), given, {}).text;
    } catch (const schema::Refusal& refusal) {
      refuse(refusal.origin, "extends", refusal.what());
    }
  }

  std::string base_text(const Value& given, const fs::path& base) {
    std::error_code unknown;
    const auto is_base = [&](const fs::path& file) { return fs::equivalent(file, base, unknown); };
    if (std::ranges::any_of(files_, is_base))
      refuse(given.origin, "extends",
             fmt::format("{} extends itself through this file, allowed: a file that does not",
                         base.string()));
    if (files_.size() >= max_files)
      refuse(given.origin, "extends",
             fmt::format("a chain of more than {} files, allowed: at most as many", max_files));
    try {
      std::string text = text_of_input(base, document::largest_file);
      problems_.add_file(base);
      return text;
    } catch (const UnfitInput& unfit) {
      refuse(given.origin, "extends",
             fmt::format("'{}': {}, allowed: the path of a scene or of part of one (TOML), "
                         "relative to the folder of this file",
                         base.string(), unfit.what()));
    }
  }

  void require_one_family(const Table& base, const Table& root) {
    const std::string* theirs = document::find_text(base, "family");
    const std::string* own = document::find_text(root, "family");
    if (theirs == nullptr || own == nullptr || *theirs == *own) return;
    const document::Origin said = document::find(base, "family")->value.origin;
    refuse(document::find(root, "family")->value.origin, "family",
           fmt::format("is \"{}\", but {}:{} says \"{}\", allowed: the family of the extended file",
                       *own, problems_.file_of(said.mark).string(), said.mark.line, *theirs));
  }

  // Removes what the extending file does not want from the base, and both keys from the extending file.
  void take_out(Table& base, Table& root) {
    if (const Entry* entry = document::find(root, "remove"))
      for (const Value& path : list_of_paths(entry->value))
        remove_path(base, path.get<std::string>(), path.origin, problems_);
    problems_.throw_if_any();
    std::erase_if(root, [](const Entry& e) { return e.key == "extends" || e.key == "remove"; });
  }

  const Array& list_of_paths(const Value& given) {
    try {
      schema::decode(key_of("remove"), given, {});
      return given.get<Array>();
    } catch (const schema::Refusal& refusal) {
      refuse(refusal.origin, "remove", refusal.what());
    }
  }

  const schema::Language& language_;
  Problems& problems_;
  std::vector<fs::path> files_;
};

}  // namespace

Table whole_tree(const std::string& text, const fs::path& file, const schema::Language& language,
                 Problems& problems) {
  return Chain(language, problems).whole(text, file);
}

}  // namespace pulvis

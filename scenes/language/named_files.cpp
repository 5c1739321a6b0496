#include "scenes/language/named_files.hpp"

namespace pulvis {
namespace {

using document::Table;
using document::Value;
using schema::Kind;

class Search {
 public:
  Search(const schema::Language& language, const std::function<void(Kind, std::string&)>& use)
      : language_(language), use_(use) {}

  void look_through(Table& table, const std::string& path) const {
    const schema::TableView& view = *schema::find_table(path, language_);
    for (document::Entry& entry : table)
      if (const schema::KeyInfo* key = schema::find_key(view, entry.key))
        look_at(*key, entry.value);
      else
        look_below(entry.value, schema::joined_path(path, entry.key));
  }

 private:
  void look_below(Value& value, const std::string& path) const {
    if (schema::find_table(path, language_) == nullptr) return;
    if (auto* table = value.as<Table>()) look_through(*table, path);
    if (document::is_array_of_tables(value))
      for (Value& element : value.get<document::Array>()) look_through(element.get<Table>(), path);
  }

  void look_at(const schema::KeyInfo& key, Value& value) const {
    auto* path = value.as<std::string>();
    const bool names_a_file = key.kind == Kind::file || key.kind == Kind::scene;
    if (names_a_file && path != nullptr && !path->empty()) use_(key.kind, *path);
  }

  const schema::Language& language_;
  const std::function<void(Kind, std::string&)>& use_;
};

}  // namespace

void for_each_path(Table& root, const schema::Language& language,
                   const std::function<void(Kind, std::string&)>& use) {
  Search(language, use).look_through(root, "");
}

}  // namespace pulvis

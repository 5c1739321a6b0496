// Reads one table of the tree according to its declaration: unknown keys, keys without effect,
// missing keys and values that cannot be decoded are reported; the rest is passed to the setters.
#pragma once

#include "scenes/language/decode.hpp"
#include "scenes/language/problem.hpp"

#include <functional>
#include <map>
#include <utility>

namespace pulvis::schema {

using Origins = std::map<std::string, document::Origin>;  // by path: "material[0].yield_stress"

class TableReader {
 public:
  TableReader(const document::Table& root, Problems& problems, const Language& language);

  template <class Spec>
  void read(const TableDeclaration<Spec>& declaration, const document::Value& value,
            const std::string& path, const std::string& parent_selected, Spec& spec) {
    if (!begin(declaration.info, value, path, parent_selected)) return;
    for (const KeyInfo& key : view_->keys)
      if (const std::optional<Decoded> decoded = value_of(key))
        declaration.keys.at(key.number).set(spec, *decoded);
  }

  // The elements of a repeated table; empty, with a problem, if it is written as anything else.
  const document::Array& elements(const document::Table& parent, const std::string& parent_path,
                                  const TableInfo& info);

  // What to add where no element of a table has the name that is referred to.
  void explain_references(
      std::function<std::string(const std::string& table, const std::string& name)> explain) {
    explain_ = std::move(explain);
  }

  // Source locations of every table and key that was read.
  const Origins& origins() const { return origins_; }

 private:
  bool begin(const TableInfo& info, const document::Value& value, const std::string& path,
             const std::string& parent_selected);
  void refuse_unknown(const document::Entry& entry, const TableView& view);
  std::optional<Decoded> value_of(const KeyInfo& key);
  void missing(const KeyInfo& key);
  bool is_choice_of_selector(const std::string& word) const;
  void without_effect(const KeyInfo& key, const document::Entry& entry);
  void collect_names(const document::Table& root);
  void collect_name(const std::string& table, const document::Value& element,
                    const std::string& path);

  Problems& problems_;
  const Language& language_;
  Names names_;
  Origins origins_;
  std::function<std::string(const std::string&, const std::string&)> explain_;

  // The table being read.
  const document::Value* table_ = nullptr;
  const TableView* view_ = nullptr;
  std::string path_;
  std::string selected_;
};

}  // namespace pulvis::schema

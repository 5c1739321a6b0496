// A language as data: every key is declared once, with its kind, unit, default, allowed range and one
// line of documentation. The reader, the reference, the JSON Schema and the default values are all
// derived from these declarations: those of scenes are in scenes/keys.
#pragma once

#include "scenes/language/document.hpp"
#include "scenes/language/vectors.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pulvis::schema {

enum class Kind {
  quantity,   // a string: number and unit
  vector,     // quantities: x and y; z as well in three dimensions
  points,     // two or more vectors
  phase,      // a quantity, or the key's single keyword
  number,     // a dimensionless number
  integer,    // an integer without a unit
  counts,     // integers without units, one per dimension
  flag,       // true or false
  direction,  // dimensionless numbers, one per dimension, not all zero
  text,       // a string
  name,       // a string that others refer to; used in result paths
  choice,     // one of a few words
  reference,  // the name of an element in another table
  name_pair,  // two names of materials or tools
  bound,      // a dimensionless number, or a quantity in a unit that another key determines
  texts,      // one or more strings
  integers,   // one or more integers
  numbers,    // one or more dimensionless numbers
  file,   // the path of a table, mesh or record, relative to the folder of the file that names it
  scene,  // the same for another scene
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false;  // the bound itself is not allowed
  bool without_high = false;

  bool holds(double value) const;  // false for NaN
};

// The dimensions of the scenes in which a key, a word or a table exists.
enum class Dimension { every, two, three };

struct Choice {
  std::string word;
  std::string doc;
  std::string formerly = {};  // its keyword in older scenes
  Dimension dimension = Dimension::every;
  int index = -1;  // in the declaration, if words of the other dimension have been left out
};

// Values of a selector: one word, or several in braces.
struct Words {
  std::vector<std::string> list;
  Words() = default;
  Words(const char* word) : list{word} {}
  Words(std::initializer_list<std::string> words) : list(words) {}
  bool empty() const { return list.empty(); }
  bool has(const std::string& word) const {
    return std::find(list.begin(), list.end(), word) != list.end();
  }
};

// Families of experiments, for tables and keys that belong only to some of them.
inline const Words compaction_only{"compaction"}, afm_only{"afm"},
    every_family{"compaction", "afm"};

// What a key says of scenes in three dimensions where that differs; what is empty does not.
struct InThreeDimensions {
  std::string doc = {};
  std::string fallback_doc = {};
  std::optional<Range> range = {};
  bool required = false;  // there only
};

struct KeyInfo {
  std::string name = {};
  std::string formerly =
      {};  // its name in older scenes, which is refused with a pointer to the new one
  Kind kind = Kind::text;
  std::string unit = {};  // SI, of quantities
  Range range = {};       // of quantities in the SI unit; for vectors, of each component
  int multiple_of = 1;    // of integers
  int components = 0;  // of vectors, points, directions, counts; 0: one per dimension of the scene
  std::vector<Choice> choices =
      {};                 // of a number, or a vector's last component: keywords allowed instead
  std::string word = {};  // Kind::phase: the keyword allowed instead of a quantity
  std::string refers_to = {};  // Kind::reference: the table whose names are allowed
  std::optional<document::Value> fallback = {};  // the default
  bool required = false;
  Words only_for = {};      // the table's selector must have one of these values
  Words optional_for = {};  // not required with these
  std::string needs = {};   // another key without which this one has no effect
  std::string doc = {};
  std::string fallback_doc = {};  // what happens without the key, if the default is not a value
  Dimension dimension = Dimension::every;
  InThreeDimensions in_3d = {};
  std::size_t number = 0;  // in its declaration (view_of)
  bool of_lever = false;   // in a table of levers, where lengths are in micrometres (view_of)
};

// A value as passed to its setter; its kind determines which members are set.
struct Decoded {
  double number = 0;  // quantity in SI, number
  std::int64_t integer = 0;
  int index = 0;  // choice, reference: index in the list
  bool is_word =
      false;  // phase; number or vector (last component) with keywords: `index` says which
  bool flag = false;
  std::array<int, 2> counts = {};
  Vec2 vector = Vec2::Zero();
  std::vector<Vec2> points = {};
  std::array<int, 3> counts3 = {};  // the same values; z = 0 in two dimensions
  Eigen::Vector3d vector3 = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> points3 = {};
  std::string text = {};
  std::vector<std::string> texts = {};
  std::vector<std::int64_t> integers = {};
  std::vector<double> numbers = {};
  std::array<std::string, 2> names = {};
};

struct TableInfo {
  std::string path;      // "material", "particle.mesh"; empty: the top level
  bool repeated;         // [[material]], any number of times; otherwise [contact], at most once
  std::string selector;  // the key that only_for compares with, here or in the parent table
  std::string doc;
  Words families = {"compaction"};  // families of experiments that have this table
  bool optional = false;  // without it the feature is absent, rather than having default values
  Dimension dimension = Dimension::every;
  std::string doc_3d = {}, selector_3d = {};  // in three dimensions, where they differ
};

template <class Spec>
struct Key {
  KeyInfo info;
  std::function<void(Spec&, const Decoded&)> set;
};

template <class Spec>
struct TableDeclaration {
  TableInfo info;
  std::vector<Key<Spec>> keys;
};

// A declaration without its setters: all that documentation, default values and checks need.
struct TableView {
  TableInfo info;
  std::vector<KeyInfo> keys;
};

// The tables of one kind of file: top level first, a parent before its children.
using Language = std::vector<TableView>;

template <class Spec>
TableView view_of(const TableDeclaration<Spec>& declaration) {
  TableView result{declaration.info, {}};
  for (const Key<Spec>& key : declaration.keys) {
    result.keys.push_back(key.info);
    result.keys.back().number = result.keys.size() - 1;
    result.keys.back().of_lever = declaration.info.families.list == afm_only.list;
  }
  return result;
}

// A table or language as scenes of this dimension (2 or 3) have it: without the tables, keys and words of the other one,
// and with the texts, ranges and numbers of components there.
TableView in_dimension(TableView view, int dimension);
Language in_dimension(const Language& language, int dimension);

const TableView* find_table(const std::string& path, const Language& language);
// Whether a table below the top level belongs to the family; for an unknown family, all do.
bool belongs(const TableInfo& info, const std::string& family);
const KeyInfo* find_key(const TableView& table, const std::string& name);
std::string joined_path(const std::string& path, const std::string& key);
// Its keys and child tables.
std::vector<std::string> known_words(const TableView& table, const Language& language);

std::string quoted(const Words& words);   // '"disc" or "ring"'
std::string allowed(const KeyInfo& key);  // "a quantity in Pa, >= 1 and <= 1e+13"

// Whether `key` has a meaning in `table`, whose selector has the value `selected`.
bool applies(const KeyInfo& key, const document::Table& table, const std::string& selected);

// Whether a table must have the key, as far as its selector determines it.
bool is_required(const KeyInfo& key, const std::string& selected);

// The value of a table's selector; taken from `parent` if the table itself has no such key.
std::string selected_by(const TableInfo& info, const document::Table& table,
                        const std::string& parent);

// Writes every missing default into the tree, so that it is read like a given value.
void fill_defaults(document::Table& root, const Language& language);

}  // namespace pulvis::schema

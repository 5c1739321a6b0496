#include "key_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "key_values.hpp"
#include "scenes/language/override.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;
using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::TableView;

constexpr int max_rounds = 12;  // cases of one base

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Table with(const Table& root, const std::vector<std::string>& settings) {
  Table changed = root;
  Problems problems("base", settings);
  apply_overrides(changed, settings, problems);
  problems.throw_if_any();
  return changed;
}

bool has_word(const Value& value, const std::string& word) {
  const auto* text = value.as<std::string>();
  const auto* array = value.as<document::Array>();
  return (text != nullptr && *text == word) ||
         (array != nullptr && std::ranges::any_of(*array, [&](const Value& element) {
            return has_word(element, word);
          }));
}

// The word of a table's selector, its own or that of a table above it.
std::string selected_at(std::string place, const std::string& selector, const Table& root) {
  for (;;) {
    const Table* table = table_at(root, place);
    const std::string* word = table == nullptr ? nullptr : document::find_text(*table, selector);
    if (word != nullptr) return *word;
    if (place.empty()) return "";
    place.erase(place.find('.') == std::string::npos ? 0 : place.rfind('.'));
  }
}

// One case in the making: a base into which one use after the other is put.
class Making {
 public:
  Making(const schema::Language& language, const fs::path& base, Table root, int round,
         const Fault& fault, Uses& missing)
      : language_(language),
        base_(base),
        root_(std::move(root)),
        replaces_(round > 0),
        fault_(fault),
        missing_(missing) {
    one_ = {base.stem().string(), base, {}, toml_of(root_)};
    std::ranges::replace(one_.name, '-', '_');
  }

  // Whether the case uses what no other one did.
  bool make() {
    const std::size_t before = missing_.size();
    for (std::size_t left = before + 1; missing_.size() < left;) {
      left = missing_.size();
      const Uses wanted = missing_;
      for (const Use& use : wanted)
        if (missing_.contains(use)) put_in(use);
    }
    one_.text = toml_of(root_);
    return missing_.size() < before;
  }

  Case made(const std::string& suffix) const {
    Case one = one_;
    one.name += suffix;
    return one;
  }

 private:
  void take_off() {
    for (const Use& use : uses_in(root_, language_)) missing_.erase(use);
  }

  void put_in(const Use& use) {
    const TableView& view = *schema::find_table(use.table, language_);
    const KeyInfo& key = *schema::find_key(view, use.key);
    const std::string* family = document::find_text(root_, "family");
    const TableView& top = *schema::find_table(use.table.substr(0, use.table.find('.')), language_);
    if (family != nullptr && !schema::belongs(top.info, *family)) return;
    for (const std::string& place : places_of(use.table, root_, language_)) {
      const bool meant =
          key.only_for.empty() || key.only_for.has(selected_at(place, view.info.selector, root_));
      if (meant && is_free(place, key, use) && put_in_at(use, view, key, place)) return;
    }
  }

  // What the base says is not changed in its first case, and nothing is changed twice.
  bool is_free(const std::string& place, const KeyInfo& key, const Use& use) const {
    const Table* table = table_at(root_, place);
    const bool there = table != nullptr && document::find(*table, key.name) != nullptr;
    return !changed_.contains(schema::joined_path(place, key.name)) &&
           (!there || (replaces_ && !use.word.empty()));
  }

  bool put_in_at(const Use& use, const TableView& view, const KeyInfo& key,
                 const std::string& place) {
    const std::vector<std::string> settings = settings_for(view, key, place, use.word);
    for (const std::string& setting : settings)
      if (take({setting})) return true;
    for (const KeyInfo& other : view.keys)
      if (other.name == key.needs || other.needs == key.name)
        for (const std::string& setting : settings)
          for (const std::string& beside : settings_for(view, other, place, ""))
            if (take({setting, beside})) return true;
    return false;
  }

  std::vector<std::string> settings_for(const TableView& view, const KeyInfo& key,
                                        const std::string& place, const std::string& word) const {
    static const Table nothing;
    const Table* around = table_at(root_, place);
    std::vector<std::string> settings;
    for (const Value& value : values_for(key, view, around == nullptr ? nothing : *around, root_))
      if (word.empty() || has_word(value, word))
        settings.push_back(schema::joined_path(place, key.name) + "=" +
                           document::value_text(value));
    return settings;
  }

  bool take(const std::vector<std::string>& settings) {
    Table changed = with(root_, settings);
    if (!fault_(toml_of(changed), base_.parent_path()).empty()) return false;
    root_ = std::move(changed);
    for (const std::string& setting : settings) {
      changed_.insert(setting.substr(0, setting.find('=')));
      one_.settings.push_back(setting);
    }
    take_off();
    return true;
  }

  const schema::Language& language_;
  const fs::path& base_;
  Table root_;
  bool replaces_;
  const Fault& fault_;
  Uses& missing_;
  Case one_;
  std::set<std::string> changed_;
};

std::vector<fs::path> bases_in(const fs::path& folder) {
  std::vector<fs::path> bases;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") bases.push_back(entry.path());
  std::ranges::sort(bases);
  return bases;
}

}  // namespace

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.base.filename().string();
  for (const std::string& setting : one.settings) *out << " --set '" << setting << "'";
}

Plan plan_for(const schema::Language& language, const fs::path& folder, const Fault& fault) {
  Plan plan;
  plan.missing = all_uses(language);
  std::vector<std::pair<fs::path, Table>> bases;
  for (const fs::path& base : bases_in(folder)) {
    const std::string text = text_of(base);
    if (const std::string wrong = fault(text, folder); !wrong.empty()) {
      plan.faults.push_back(base.filename().string() + ": " + wrong);
      continue;
    }
    bases.emplace_back(base, document::parse(text));
    for (const Use& use : uses_in(bases.back().second, language)) plan.missing.erase(use);
  }
  for (const auto& [base, root] : bases)
    for (int round = 0; round < max_rounds; ++round) {
      Making making(language, base, root, round, fault, plan.missing);
      if (round == 0) plan.cases.push_back(making.made(""));  // with all its defaults
      const bool is_new = making.make();
      if (is_new) plan.cases.push_back(making.made(fmt::format("_{}", round + 1)));
      if (!is_new && round > 0) break;
    }
  return plan;
}

}  // namespace pulvis::keys

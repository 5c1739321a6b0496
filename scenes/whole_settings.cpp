#include "scenes/whole_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "engine/files/input_file.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/document.hpp"
#include "scenes/language/named_files.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using document::Array;
using document::Table;
using document::Value;

// Links among the folders are resolved, as when opening the file; the file keeps the name it was given.
fs::path placed(const fs::path& path) {
  const fs::path whole = fs::absolute(path);
  return fs::weakly_canonical(whole.parent_path()) / whole.filename();
}

struct Change {  // of one string
  SourceMark mark;
  std::string text;
};

void add_changes(const Value& before, const Value& after, std::vector<Change>& changes) {
  if (const auto* text = before.as<std::string>()) {
    if (*text != after.get<std::string>())
      changes.push_back({before.origin.mark, document::value_text(after)});
  } else if (const auto* array = before.as<Array>()) {
    for (std::size_t i = 0; i < array->size(); ++i)
      add_changes((*array)[i], after.get<Array>()[i], changes);
  } else if (const auto* table = before.as<Table>()) {
    for (std::size_t i = 0; i < table->size(); ++i)
      add_changes((*table)[i].value, after.get<Table>()[i].value, changes);
  }
}

// Columns count characters, not bytes.
std::size_t position_of(const std::string& text, SourceMark mark) {
  std::size_t at = 0;
  for (int line = 1; line < mark.line; ++line) at = text.find('\n', at) + 1;
  const auto continues = [&] {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  for (int column = 1; column < mark.column; ++column) {
    ++at;
    while (continues()) ++at;
  }
  return at;
}

// Position after the string that begins there.
std::size_t end_of_string(const std::string& text, std::size_t at) {
  const char quote = text.at(at);
  const bool is_long = text.compare(at, 3, std::string(3, quote)) == 0;
  const std::string closing(is_long ? 3 : 1, quote);
  for (at += closing.size(); text.compare(at, closing.size(), closing) != 0; ++at)
    if (quote == '"' && text.at(at) == '\\') ++at;
  return at + closing.size();
}

// Position after the array that begins there.
std::size_t end_of_array(const std::string& text, std::size_t at) {
  int open = 0;
  do {
    const char c = text.at(at);
    if (c == '[') ++open;
    if (c == ']') --open;
    if (c == '"' || c == '\'')
      at = end_of_string(text, at);
    else
      at = c == '#' ? text.find('\n', at) : at + 1;
  } while (open > 0);
  return at;
}

std::string with_changes(std::string text, std::vector<Change> changes) {
  std::ranges::sort(changes, [](const Change& a, const Change& b) {
    return std::pair(a.mark.line, a.mark.column) > std::pair(b.mark.line, b.mark.column);
  });
  for (const Change& change : changes) {
    const std::size_t at = position_of(text, change.mark);
    text.replace(at, end_of_string(text, at) - at, change.text);
  }
  return text;
}

class Gathering {
 public:
  explicit Gathering(const GivenSettings& given) : given_(given) {
    Table root = document::parse(given.text);
    for_each_path(root, given.language, [&](schema::Kind kind, std::string& path) {
      const fs::path file = given_.file.parent_path() / path;
      add(file, kind == schema::Kind::scene);
      if (kind == schema::Kind::scene) scene_folders_.insert(placed(file).parent_path());
    });
    for (const fs::path& file : given.read) add(file, file.extension() == ".toml");
    find_top();
  }

  WholeSettings whole() const {
    WholeSettings made;
    for (const auto& [file, text] : files_) {
      InputFile input{file, copy_of(file), {}, 0};
      if (text)
        input.text = moved(*text, schema::scene_language(), file.parent_path(),
                           input.copy.parent_path(), false);
      else
        input.hash = file_hash(file);
      made.inputs.push_back(std::move(input));
    }
    made.text =
        with_overrides(moved(given_.text, given_.language, given_.file.parent_path(), "", true));
    return made;
  }

 private:
  void add(const fs::path& path, bool is_scene) {
    const fs::path file = placed(path);
    std::error_code none;
    if (files_.contains(file) || !fs::is_regular_file(file, none)) return;
    std::optional<std::string>& text = files_[file];
    if (is_scene) add_scene(file, text);
  }

  // A file that is not used in the end may not be a scene at all: it is copied unchanged.
  void add_scene(const fs::path& file, std::optional<std::string>& text) {
    Table root;
    try {
      text = text_of_input(file, document::largest_file);
      root = document::parse(*text);
    } catch (const UnfitInput&) {
      return;
    } catch (const document::SyntaxError&) {
      text.reset();
      return;
    }
    for_each_path(root, schema::scene_language(), [&](schema::Kind kind, std::string& named) {
      add(file.parent_path() / named, kind == schema::Kind::scene);
    });
  }

  // The lowest folder that contains all of them.
  void find_top() {
    if (files_.empty()) return;
    top_ = files_.begin()->first.parent_path();
    const auto is_below = [&](const auto& file) {
      return *file.first.lexically_relative(top_).begin() != "..";
    };
    while (!std::ranges::all_of(files_, is_below)) top_ = top_.parent_path();
  }

  // The name of the top folder is kept, so that a copy of a copy has the same location as the copy.
  fs::path copy_of(const fs::path& file) const {
    const fs::path inputs = "inputs";
    const fs::path name = top_.filename() == inputs ? fs::path() : top_.filename();
    return inputs / name / file.lexically_relative(top_);
  }

  // A text that is moved from one folder to another, among the copies.
  std::string moved(const std::string& text, const schema::Language& language, const fs::path& from,
                    const fs::path& to, bool has_overrides) const {
    Value before{document::parse(text), {}};
    Value after = before;
    for_each_path(after.get<Table>(), language, [&](schema::Kind, std::string& path) {
      const fs::path file = placed(from / path);
      if (!files_.contains(file)) return;
      const fs::path way = to.empty() ? copy_of(file) : copy_of(file).lexically_relative(to);
      if (way != fs::path(path).lexically_normal()) path = way.string();
    });
    if (has_overrides && scene_folders_.size() == 1) move_absolute(after);
    std::vector<Change> changes;
    add_changes(before, after, changes);
    return with_changes(text, std::move(changes));
  }

  // After the file's own `overrides`, in the order in which they are applied.
  std::string with_overrides(std::string text) const {
    const Table root = document::parse(text);
    const document::Entry* own = document::find(root, "overrides");
    Array changes = own == nullptr ? Array{} : own->value.get<Array>();
    for (const std::string& change : given_.overrides) changes.push_back({change, {}});
    for (Value& change : changes) change = {moved_change(change.get<std::string>()), {}};
    if (changes.empty()) return text;
    const std::string list = document::value_text({std::move(changes), {}});
    if (own == nullptr) return fmt::format("overrides = {}\n{}", list, text);
    const std::size_t at = position_of(text, own->value.origin.mark);
    return text.replace(at, end_of_array(text, at) - at, list);
  }

  // "outline.file=/where/it/is.svg"; on one line.
  std::string moved_change(std::string change) const {
    std::ranges::replace_if(
        change, [](unsigned char c) { return c < 0x20; }, ' ');
    const std::size_t value = change.find_first_not_of(" =", change.find('='));
    if (value == std::string::npos || scene_folders_.size() != 1) return change;
    const std::string text = change.substr(value);
    const Value before = document::parse_value(text).value_or(Value{text, {}});
    Value after = before;
    move_absolute(after);
    const bool same = document::value_text(after) == document::value_text(before);
    return same ? change : change.substr(0, value) + document::value_text(after);
  }

  // Paths among the values that a study sets in its scene are recognised by the file they lead to.
  void move_absolute(Value& value) const {
    if (auto* text = value.as<std::string>()) {
      if (fs::path(*text).is_absolute() && files_.contains(placed(*text)))
        *text = copy_of(placed(*text))
                    .lexically_relative(copy_of(*scene_folders_.begin() / "scene").parent_path())
                    .string();
    } else if (auto* array = value.as<Array>()) {
      for (Value& element : *array) move_absolute(element);
    } else if (auto* table = value.as<Table>()) {
      for (document::Entry& entry : *table) move_absolute(entry.value);
    }
  }

  const GivenSettings& given_;
  std::map<fs::path, std::optional<std::string>> files_;  // text: for a scene
  std::set<fs::path> scene_folders_;
  fs::path top_;
};

}  // namespace

WholeSettings whole_settings(const GivenSettings& given) { return Gathering(given).whole(); }

}  // namespace pulvis

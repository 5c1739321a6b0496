#include "scenes/language/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace pulvis {
namespace {

std::string code(const std::string& text) { return fmt::format("`{}`", text); }

// Contents of a column in a Markdown table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string default_text(const schema::KeyInfo& key) {
  if (key.required && !key.optional_for.empty())
    return fmt::format("required, but not with {}", schema::quoted(key.optional_for));
  if (key.required) return "required";
  if (const auto* array = key.fallback ? key.fallback->as<document::Array>() : nullptr;
      array != nullptr && array->size() == 1)
    return code(document::value_text(array->front())) + " each";
  if (key.fallback) return code(document::value_text(*key.fallback));
  return key.fallback_doc;
}

std::string meaning(const schema::KeyInfo& key, const std::string& selector) {
  std::string text = key.doc;
  for (const schema::Choice& choice : key.choices)
    text += fmt::format(" `\"{}\"`: {}.", choice.word, choice.doc);
  if (!key.only_for.empty())
    text += fmt::format(" Only with {} = {}.", selector, schema::quoted(key.only_for));
  if (!key.needs.empty()) text += fmt::format(" Only together with `{}`.", key.needs);
  return text;
}

std::string heading(const schema::TableInfo& info) {
  if (info.path.empty()) return "Top level";
  return info.repeated ? fmt::format("`[[{}]]`", info.path) : fmt::format("`[{}]`", info.path);
}

// A key as a table of one dimension has it.
std::optional<schema::KeyInfo> as_in(const schema::TableView& view, const schema::KeyInfo& key) {
  const auto found = std::ranges::find_if(view.keys, [&](const schema::KeyInfo& other) {
    return other.number == key.number && other.dimension == key.dimension;
  });
  return found == view.keys.end() ? std::nullopt : std::optional(*found);
}

// With the number of components that it has in both dimensions.
schema::KeyInfo with_any_components(schema::KeyInfo own, const schema::KeyInfo& key) {
  own.components = key.components;
  own.fallback = key.fallback;
  return own;
}

std::string row(const schema::KeyInfo& key, const std::string& selector,
                const std::string& dimensions) {
  return fmt::format("| `{}` |{} {} | {} | {} |\n", key.name, dimensions,
                     cell(schema::allowed(key)), cell(default_text(key)),
                     cell(meaning(key, selector)));
}

std::string rows_of(const schema::TableView& view) {
  std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const schema::KeyInfo& key : view.keys) text += row(key, view.info.selector, "");
  return text;
}

// One row for both dimensions if they say the same.
std::string rows_of_dimensions(const schema::TableView& view) {
  const std::array views{schema::in_dimension(view, 2), schema::in_dimension(view, 3)};
  std::string text = "| key | in | value | default | meaning |\n|---|---|---|---|---|\n";
  for (const schema::KeyInfo& key : view.keys) {
    const std::array own{as_in(views[0], key), as_in(views[1], key)};
    const auto in_both = [&](std::size_t d) {
      return row(with_any_components(*own[d], key), views[d].info.selector, " 2D, 3D |");
    };
    if (own[0] && own[1] && in_both(0) == in_both(1)) {
      text += in_both(0);
      continue;
    }
    if (own[0]) text += row(*own[0], views[0].info.selector, " 2D |");
    if (own[1]) text += row(*own[1], views[1].info.selector, " 3D |");
  }
  return text;
}

// `of_families`: whether the files of this language name a family of experiments. `of_dimensions`: whether they have two
// or three dimensions.
std::string describe(const schema::TableView& view, bool of_families, bool of_dimensions) {
  std::string text = fmt::format("\n## {}\n\n{}", heading(view.info), view.info.doc);
  if (view.info.dimension == schema::Dimension::two) text += " In two dimensions only.";
  if (of_families && view.info.families.list.size() == 1)
    text += fmt::format(" Only with family = {}.", schema::quoted(view.info.families));
  text += "\n";
  if (!view.info.doc_3d.empty())
    text += fmt::format("\nIn three dimensions: {}\n", view.info.doc_3d);
  if (view.keys.empty()) return text;  // its keys belong to another language
  const bool both = of_dimensions && view.info.dimension == schema::Dimension::every &&
                    view.info.families.has("compaction");
  return text + "\n" + (both ? rows_of_dimensions(view) : rows_of(view));
}

}  // namespace

std::string reference_of(const std::string& beginning, const schema::Language& language) {
  std::string text = beginning;
  const schema::KeyInfo* family = schema::find_key(language.front(), "family");
  const bool of_families = family != nullptr && family->choices.size() > 1;
  const bool of_dimensions = schema::find_key(language.front(), "dimension") != nullptr;
  for (const schema::TableView& view : language) text += describe(view, of_families, of_dimensions);
  return text;
}

}  // namespace pulvis

#include "scenes/language/describe.hpp"

#include <fmt/format.h>

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

// `of_families`: whether the files of this language name a family of experiments.
std::string describe(const schema::TableView& view, bool of_families) {
  std::string text = fmt::format("\n## {}\n\n{}", heading(view.info), view.info.doc);
  if (of_families && view.info.families.list.size() == 1)
    text += fmt::format(" Only with family = {}.", schema::quoted(view.info.families));
  text += "\n";
  if (view.keys.empty()) return text;  // its keys belong to another language
  text += "\n";
  text += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const schema::KeyInfo& key : view.keys)
    text += fmt::format("| `{}` | {} | {} | {} |\n", key.name, cell(schema::allowed(key)),
                        cell(default_text(key)), cell(meaning(key, view.info.selector)));
  return text;
}

}  // namespace

std::string reference_of(const std::string& beginning, const schema::Language& language) {
  std::string text = beginning;
  const schema::KeyInfo* family = schema::find_key(language.front(), "family");
  const bool of_families = family != nullptr && family->choices.size() > 1;
  for (const schema::TableView& view : language) text += describe(view, of_families);
  return text;
}

}  // namespace pulvis

// docs/scene.md, from the declarations.
#include "scenes/describe.hpp"

#include <fmt/format.h>

namespace pulvis {
namespace {

constexpr const char* introduction = R"(# The scene file

<!-- Generated from the declarations in scenes/declare_*.cpp: change those, not this file. -->

A scene is a TOML file that declares one experiment. It is checked before anything runs: unknown
keys, wrong units, values that are impossible or have no effect, and references to names that do not
exist are refused as `file:line:col: key: what is wrong, allowed: what is allowed`.

**Quantities** are strings of a number and a unit: `"10 mm"`, `"200 GPa"`, `"0.3 N/um^2"`,
`"45 deg"`. Any unit of the right dimension will do; a bare number is refused where a unit is needed.
Ranges below are in SI units. **Numbers** without a dimension are written bare: `0.3`.

**Overrides** on the command line change one key: `--set key.path=value`. An element of a repeated
table is chosen by position or by name (a move: by its tool); a name with a dot is quoted. A value
that is not TOML is taken as a string.

```
--set time.safety=0.5
--set "material[0].yield_stress=100 MPa"     --set "material.316L.yield_stress=100 MPa"
--set "stage.press.duration=2 ms"            --set stage.press.move.top.ramp=0.2
--set 'tool.top.point=["0 m", "101 mm"]'
```
)";

std::string code(const std::string& text) { return fmt::format("`{}`", text); }

// What stands in a column of a Markdown table.
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

// `of_families`: whether the files of this language say what kind of experiment they are.
std::string describe(const schema::TableView& view, bool of_families) {
  std::string text = fmt::format("\n## {}\n\n{}", heading(view.info), view.info.doc);
  if (of_families && view.info.families.list.size() == 1)
    text += fmt::format(" Only with family = {}.", schema::quoted(view.info.families));
  text += "\n";
  if (view.keys.empty()) return text;  // its keys are not ours
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
  const bool of_families = schema::find_key(language.front(), "family") != nullptr;
  for (const schema::TableView& view : language) text += describe(view, of_families);
  return text;
}

std::string scene_reference() { return reference_of(introduction, schema::all_tables()); }

}  // namespace pulvis

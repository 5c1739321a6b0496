// docs/scene.schema.json, from the declarations: for editors that complete and check TOML. It contains
// the structure of a scene; units, references and checks across tables are left to the reader.
#include "scenes/language/describe_schema.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const document::Value& value) {
  if (const auto* flag = value.as<bool>()) return *flag;
  if (const auto* integer = value.as<std::int64_t>()) return *integer;
  if (const auto* number = value.as<double>()) return *number;
  if (const auto* text = value.as<std::string>()) return *text;
  Json array = Json::array();
  for (const document::Value& element : value.get<document::Array>())
    array.push_back(json_of(element));
  return array;
}

void add_range(Json& json, const schema::Range& range) {
  if (std::isfinite(range.low))
    json[range.without_low ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high))
    json[range.without_high ? "exclusiveMaximum" : "maximum"] = range.high;
}

// A number and its unit, which after a space may begin with a digit: "20000 1/s". What looks like the rest of a number
// (".5", "e3") is none.
constexpr const char* quantity_pattern =
    "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?(\\s+[0-9]+)?"
    "\\s*([^0-9\\s.eE]|[eE][^0-9+-]).*$";

Json quantity_type() { return {{"type", "string"}, {"pattern", quantity_pattern}}; }

// `count` 0: two or three.
Json list_of(const Json& item, int count) {
  return {{"type", "array"},
          {"items", item},
          {"minItems", count == 0 ? 2 : count},
          {"maxItems", count == 0 ? 3 : count}};
}

Json words(const std::vector<schema::Choice>& choices) {
  Json list = Json::array();
  for (const schema::Choice& choice : choices) list.push_back(choice.word);
  return {{"enum", list}};
}

Json text_type(int max_length) { return {{"type", "string"}, {"maxLength", max_length}}; }

Json list_type(const char* type) {
  return {{"type", "array"}, {"items", {{"type", type}}}, {"minItems", 1}};
}

Json in_range(const char* type, const schema::Range& range) {
  Json json{{"type", type}};
  add_range(json, range);
  return json;
}

Json vector_type(const schema::KeyInfo& key) {
  Json json = list_of(quantity_type(), key.components);
  if (!key.choices.empty())
    json["items"] = {{"anyOf", Json::array({words(key.choices), quantity_type()})}};
  return json;
}

Json number_type(const schema::KeyInfo& key) {
  Json number = in_range("number", key.range);
  if (key.choices.empty()) return number;
  return {{"anyOf", Json::array({words(key.choices), number})}};
}

Json type_of(const schema::KeyInfo& key) {
  using schema::Kind;
  switch (key.kind) {
    case Kind::quantity:
      return quantity_type();
    case Kind::vector:
      return vector_type(key);
    case Kind::points:
      return {
          {"type", "array"}, {"items", list_of(quantity_type(), key.components)}, {"minItems", 2}};
    case Kind::phase:
      return {{"anyOf", Json::array({Json{{"const", key.word}}, quantity_type()})}};
    case Kind::number:
      return number_type(key);
    case Kind::integer:
      return in_range("integer", key.range);
    case Kind::counts:
      return list_of(in_range("integer", key.range), key.components);
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::direction:
      return list_of({{"type", "number"}}, key.components);
    case Kind::text:
      return text_type(200);
    case Kind::file:
    case Kind::scene:
      return text_type(1000);
    case Kind::name:
      return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_.+-]{1,64}$"}};
    case Kind::choice:
      return words(key.choices);
    case Kind::reference:
      return {{"type", "string"}};
    case Kind::name_pair:
      return list_of({{"type", "string"}}, 2);
    case Kind::texts:
      return list_type("string");
    case Kind::integers:
      return list_type("integer");
    case Kind::numbers:
      return list_type("number");
    case Kind::bound:
      return {{"anyOf", Json::array({Json{{"type", "number"}}, quantity_type()})}};
  }
  return {};
}

Json property(const schema::KeyInfo& key) {
  Json json = type_of(key);
  if (key.multiple_of > 1) json["multipleOf"] = key.multiple_of;
  json["description"] = fmt::format("{} Allowed: {}.", key.doc, schema::allowed(key));
  const bool is_complete =
      key.fallback && (key.kind != schema::Kind::vector || key.components != 0);
  if (is_complete) json["default"] = json_of(*key.fallback);
  return json;
}

// Of all keys with one name: two if either dimension has its own.
Json property(const std::vector<const schema::KeyInfo*>& keys) {
  Json json = property(*keys.front());
  if (keys.size() == 1) return json;
  json = {{"anyOf", Json::array({json})}};
  for (std::size_t i = 1; i < keys.size(); ++i) json["anyOf"].push_back(property(*keys[i]));
  return json;
}

std::vector<const schema::KeyInfo*> keys_called(const std::string& name,
                                                const schema::TableView& view) {
  std::vector<const schema::KeyInfo*> keys;
  for (const schema::KeyInfo& key : view.keys)
    if (key.name == name) keys.push_back(&key);
  return keys;
}

std::vector<const schema::TableView*> children(const std::string& path,
                                               const schema::Language& language) {
  std::vector<const schema::TableView*> result;
  for (const schema::TableView& view : language) {
    const auto dot = view.info.path.rfind('.');
    const std::string parent = dot == std::string::npos ? "" : view.info.path.substr(0, dot);
    if (!view.info.path.empty() && parent == path) result.push_back(&view);
  }
  return result;
}

std::string name_of(const schema::TableView& view) {
  return view.info.path.substr(view.info.path.rfind('.') + 1);
}

std::vector<const char*> tables_required(const std::string& family) {
  if (family == "afm") return {"lever"};
  return {"particle", "stage"};
}

// A whole file, or one that extends another and so may omit anything.
enum class Extent { whole, part };

// Anything in a library may be omitted, except a name, which others refer to.
void require(Json& json, const Json& required, const schema::TableView& view) {
  if (required.empty()) return;
  if (schema::find_key(view, "library") == nullptr) {
    json["required"] = required;
    return;
  }
  Json with_library{"library"};
  if (std::ranges::find(required, Json("name")) != required.end()) with_library.push_back("name");
  json["anyOf"] = {Json{{"required", with_library}}, Json{{"required", required}}};
}

// For one value of a selector: requires its keys, and forbids the keys of other values, in
// the table itself and in its subtables.
Json branch(const schema::TableView& view, const std::string& selector, const std::string& selected,
            const schema::Language& language, Extent extent) {
  Json required = Json::array(), properties = Json::object();
  for (const schema::KeyInfo& key : view.keys) {
    const auto is_meant = [&](const schema::KeyInfo* one) {
      return one->only_for.empty() || one->only_for.has(selected);
    };
    if (std::ranges::none_of(keys_called(key.name, view), is_meant)) properties[key.name] = false;
    const bool by_value =
        key.only_for.empty() ? !key.optional_for.empty() : key.only_for.has(selected);
    if (by_value && schema::is_required(key, selected)) required.push_back(key.name);
  }
  for (const schema::TableView* child : children(view.info.path, language))
    if (child->info.selector == selector || child->info.selector_3d == selector)
      properties[name_of(*child)] = branch(*child, selector, selected, language, extent);
  if (view.info.path.empty()) {
    for (const schema::TableView* child : children("", language))
      if (!schema::belongs(child->info, selected)) properties[name_of(*child)] = false;
    for (const char* table : tables_required(selected)) required.push_back(table);
  }
  Json json{{"properties", properties}};
  if (extent == Extent::whole) require(json, required, view);
  return json;
}

// Whether the selector has this value. A selector that is left out has its default, except in a file that extends another.
Json selects(const schema::KeyInfo& selector, const std::string& word, Extent extent) {
  Json test{{"properties", {{selector.name, {{"const", word}}}}}};
  const auto* usual = selector.fallback ? selector.fallback->as<std::string>() : nullptr;
  if (extent == Extent::part || usual == nullptr || *usual != word)
    test["required"] = {selector.name};
  return test;
}

void add_branches(Json& json, const schema::TableView& view, const std::string& selector,
                  const schema::Language& language, Extent extent) {
  std::set<std::string> done;  // words that both dimensions have
  for (const schema::KeyInfo* key : keys_called(selector, view))
    for (const schema::Choice& choice : key->choices)
      if (done.insert(choice.word).second)
        json["allOf"].push_back({{"if", selects(*key, choice.word, extent)},
                                 {"then", branch(view, selector, choice.word, language, extent)}});
}

// User-defined names, as in [let].
Json table_of_variables(const schema::TableView& view) {
  return {{"type", "object"},
          {"description", view.info.doc},
          {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}}},
          {"additionalProperties", {{"type", {"number", "string"}}}}};
}

// Numbers and quantities may be expressions of variables: those start with a name, a bracket or a number, and contain
// an operator.
void allow_expressions(Json& json) {
  for (Json& inner : json)
    if (inner.is_structured()) allow_expressions(inner);
  if (!json.is_object() || !json.contains("type")) return;
  Json& type = json["type"];
  if (type == "number" || type == "integer") {
    type = {type, "string"};
    json["pattern"] = "[A-Za-z_(*/^+]";
  } else if (type == "string" && json.contains("pattern") && json["pattern"] == quantity_pattern) {
    json["pattern"] = fmt::format("{}|^\\s*[+-]?\\s*[A-Za-z_(]", quantity_pattern);
  }
}

Json table(const schema::TableView& view, const schema::Language& language, Extent extent) {
  if (view.info.path == "let") return table_of_variables(view);
  Json json{{"type", "object"}, {"description", view.info.doc}, {"additionalProperties", false}};
  Json required = Json::array();
  for (const schema::KeyInfo& key : view.keys) {
    json["properties"][key.name] = property(keys_called(key.name, view));
    if (key.required && key.only_for.empty() && key.optional_for.empty())
      required.push_back(key.name);
    if (!key.needs.empty() && extent == Extent::whole)
      json["dependentRequired"][key.name] = {key.needs};
  }
  for (const schema::TableView* child : children(view.info.path, language)) {
    Json inner = table(*child, language, extent);
    if (child->info.repeated) inner = {{"type", "array"}, {"minItems", 1}, {"items", inner}};
    json["properties"][name_of(*child)] = inner;
  }
  if (extent == Extent::whole) require(json, required, view);
  add_branches(json, view, view.info.selector, language, extent);
  if (view.info.selector_3d != view.info.selector)
    add_branches(json, view, view.info.selector_3d, language, extent);
  return json;
}

Json whole_file(const schema::Language& language, const std::vector<std::string>& required) {
  Json whole = table(language.front(), language, Extent::whole);
  for (const std::string& key : required) whole["required"].push_back(key);
  if (schema::find_table("let", language) != nullptr) allow_expressions(whole);
  return whole;
}

// A file that extends no other is complete, in its dimension.
void add_whole_files(Json& json, const schema::Language& language,
                     const std::vector<std::string>& required) {
  json["if"]["not"]["required"] = {"extends"};
  if (schema::find_key(language.front(), "dimension") == nullptr) {
    json["then"]["$ref"] = "#/$defs/whole";
    json["$defs"]["whole"] = whole_file(language, required);
    return;
  }
  const Json three{{"properties", {{"dimension", {{"const", 3}}}}}, {"required", {"dimension"}}};
  json["then"] = {{"if", three},
                  {"then", {{"$ref", "#/$defs/three-dimensions"}}},
                  {"else", {{"$ref", "#/$defs/two-dimensions"}}}};
  json["$defs"]["two-dimensions"] = whole_file(schema::in_dimension(language, 2), required);
  json["$defs"]["three-dimensions"] = whole_file(schema::in_dimension(language, 3), required);
}

}  // namespace

std::string json_schema_of(const std::string& title, const std::string& declared_in,
                           const schema::Language& language,
                           const std::vector<std::string>& required) {
  Json json{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", title},
            {"$comment", "Generated from the declarations in " + declared_in + "."}};
  if (schema::find_key(language.front(), "extends") == nullptr) {
    json.update(whole_file(language, required));
    return json.dump(2) + "\n";
  }
  Json part = table(language.front(), language, Extent::part);
  if (schema::find_table("let", language) != nullptr) allow_expressions(part);
  json.update(part);
  add_whole_files(json, language, required);
  return json.dump(2) + "\n";
}

}  // namespace pulvis

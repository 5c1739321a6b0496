// docs/scene.schema.json, from the declarations: for editors that complete and check TOML. It contains
// the structure of a scene; units, references and checks across tables are left to the reader.
#include "scenes/language/describe_schema.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

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

Json list_of(const Json& item, int count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
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
  Json json = list_of(quantity_type(), key.dimensions);
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
          {"type", "array"}, {"items", list_of(quantity_type(), key.dimensions)}, {"minItems", 2}};
    case Kind::phase:
      return {{"anyOf", Json::array({Json{{"const", key.word}}, quantity_type()})}};
    case Kind::number:
      return number_type(key);
    case Kind::integer:
      return in_range("integer", key.range);
    case Kind::counts:
      return list_of(in_range("integer", key.range), key.dimensions);
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::direction:
      return list_of({{"type", "number"}}, key.dimensions);
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
  if (key.fallback) json["default"] = json_of(*key.fallback);
  return json;
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

// For one value of the selector: requires its keys, and forbids the keys of other values, in
// the table itself and in its subtables.
Json branch(const schema::TableView& view, const std::string& selected,
            const schema::Language& language, Extent extent) {
  Json required = Json::array(), properties = Json::object();
  for (const schema::KeyInfo& key : view.keys) {
    if (key.only_for.empty()) continue;
    if (!key.only_for.has(selected)) properties[key.name] = false;
    if (key.only_for.has(selected) && schema::is_required(key, selected))
      required.push_back(key.name);
  }
  for (const schema::TableView* child : children(view.info.path, language))
    if (child->info.selector == view.info.selector)
      properties[name_of(*child)] = branch(*child, selected, language, extent);
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

void add_branches(Json& json, const schema::TableView& view, const schema::Language& language,
                  Extent extent) {
  const schema::KeyInfo* selector = schema::find_key(view, view.info.selector);
  if (selector == nullptr) return;
  for (const schema::Choice& choice : selector->choices)
    json["allOf"].push_back({{"if", selects(*selector, choice.word, extent)},
                             {"then", branch(view, choice.word, language, extent)}});
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
    json["properties"][key.name] = property(key);
    if (key.required && key.only_for.empty()) required.push_back(key.name);
    if (!key.needs.empty() && extent == Extent::whole)
      json["dependentRequired"][key.name] = {key.needs};
  }
  for (const schema::TableView* child : children(view.info.path, language)) {
    Json inner = table(*child, language, extent);
    if (child->info.repeated) inner = {{"type", "array"}, {"minItems", 1}, {"items", inner}};
    json["properties"][name_of(*child)] = inner;
  }
  if (extent == Extent::whole) require(json, required, view);
  add_branches(json, view, language, extent);
  return json;
}

}  // namespace

std::string json_schema_of(const std::string& title, const std::string& declared_in,
                           const schema::Language& language,
                           const std::vector<std::string>& required) {
  Json json{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", title},
            {"$comment", "Generated from the declarations in " + declared_in + "."}};
  Json whole = table(language.front(), language, Extent::whole);
  for (const std::string& key : required) whole["required"].push_back(key);
  const bool has_variables = schema::find_table("let", language) != nullptr;
  if (has_variables) allow_expressions(whole);
  if (schema::find_key(language.front(), "extends") == nullptr) {
    json.update(whole);
    return json.dump(2) + "\n";
  }
  Json part = table(language.front(), language, Extent::part);
  if (has_variables) allow_expressions(part);
  json.update(part);
  json["if"]["not"]["required"] = {"extends"};
  json["then"]["$ref"] = "#/$defs/whole";
  json["$defs"]["whole"] = whole;
  return json.dump(2) + "\n";
}

}  // namespace pulvis

// docs/scene.schema.json, from the declarations: for editors that complete and check TOML. It knows
// the shape of a scene; units, references and checks across tables are the reader's.
#include "scenes/language/describe_schema.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

Json quantity() {
  return {{"type", "string"},
          {"pattern", "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?\\s*[^0-9\\s].*$"}};
}

Json pair_of(const Json& item) {
  return {{"type", "array"}, {"items", item}, {"minItems", 2}, {"maxItems", 2}};
}

Json words(const std::vector<schema::Choice>& choices) {
  Json list = Json::array();
  for (const schema::Choice& choice : choices) list.push_back(choice.word);
  return {{"enum", list}};
}

Json type_of(const schema::KeyInfo& key) {
  using schema::Kind;
  Json json;
  switch (key.kind) {
    case Kind::quantity:
      json = quantity();
      break;
    case Kind::vector:
      json = pair_of(quantity());
      if (!key.choices.empty())
        json["items"] = {{"anyOf", Json::array({words(key.choices), quantity()})}};
      break;
    case Kind::points:
      json = {{"type", "array"}, {"items", pair_of(quantity())}, {"minItems", 2}};
      break;
    case Kind::phase:
      json["anyOf"] = Json::array({Json{{"const", key.word}}, quantity()});
      break;
    case Kind::number:
      json["type"] = "number";
      add_range(json, key.range);
      if (!key.choices.empty()) json = {{"anyOf", Json::array({words(key.choices), json})}};
      break;
    case Kind::integer:
      json["type"] = "integer";
      add_range(json, key.range);
      break;
    case Kind::counts: {
      Json count{{"type", "integer"}};
      add_range(count, key.range);
      json = pair_of(count);
      break;
    }
    case Kind::flag:
      json["type"] = "boolean";
      break;
    case Kind::direction:
      json = pair_of({{"type", "number"}});
      break;
    case Kind::text:
      json = {{"type", "string"}, {"maxLength", 200}};
      break;
    case Kind::file:
    case Kind::scene:
      json = {{"type", "string"}, {"maxLength", 1000}};
      break;
    case Kind::name:
      json = {{"type", "string"}, {"pattern", "^[A-Za-z0-9_.+-]{1,64}$"}};
      break;
    case Kind::choice:
      json = words(key.choices);
      break;
    case Kind::reference:
      json["type"] = "string";
      break;
    case Kind::name_pair:
      json = pair_of({{"type", "string"}});
      break;
    case Kind::texts:
      json = {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 1}};
      break;
    case Kind::integers:
      json = {{"type", "array"}, {"items", {{"type", "integer"}}}, {"minItems", 1}};
      break;
    case Kind::bound:
      json["anyOf"] = Json::array({Json{{"type", "number"}}, quantity()});
      break;
  }
  if (key.multiple_of > 1) json["multipleOf"] = key.multiple_of;
  return json;
}

Json property(const schema::KeyInfo& key) {
  Json json = type_of(key);
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

std::string last_word(const schema::TableView& view) {
  return view.info.path.substr(view.info.path.rfind('.') + 1);
}

std::vector<const char*> tables_required(const std::string& family) {
  if (family == "afm") return {"lever"};
  return {"particle", "stage"};
}

// A whole file, or one that extends another and so may leave out anything.
enum class Extent { whole, part };

// For one value of the selector: the keys it requires, and the keys of other values forbidden, in
// the table itself and in the tables below it.
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
      properties[last_word(*child)] = branch(*child, selected, language, extent);
  if (view.info.path.empty()) {
    for (const schema::TableView* child : children("", language))
      if (!schema::belongs(child->info, selected)) properties[last_word(*child)] = false;
    for (const char* table : tables_required(selected)) required.push_back(table);
  }
  Json json{{"properties", properties}};
  if (!required.empty() && extent == Extent::whole) json["required"] = required;
  return json;
}

void add_branches(Json& json, const schema::TableView& view, const schema::Language& language,
                  Extent extent) {
  const schema::KeyInfo* selector = schema::find_key(view, view.info.selector);
  if (selector == nullptr) return;
  for (const schema::Choice& choice : selector->choices) {
    Json test{{"properties", {{selector->name, {{"const", choice.word}}}}}};
    if (extent == Extent::part) test["required"] = {selector->name};
    json["allOf"].push_back({{"if", test}, {"then", branch(view, choice.word, language, extent)}});
  }
}

Json table(const schema::TableView& view, const schema::Language& language, Extent extent) {
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
    json["properties"][last_word(*child)] = inner;
  }
  if (!required.empty() && extent == Extent::whole) json["required"] = required;
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
  if (schema::find_key(language.front(), "extends") == nullptr) {
    json.update(whole);
    return json.dump(2) + "\n";
  }
  json.update(table(language.front(), language, Extent::part));
  json["if"]["not"]["required"] = {"extends"};
  json["then"]["$ref"] = "#/$defs/whole";
  json["$defs"]["whole"] = whole;
  return json.dump(2) + "\n";
}

}  // namespace pulvis

// The committed descriptions of the scene language are those the declarations give.
// To renew them: pulvis check --reference text, or schema; or copy what the failing test found.
#include "scenes/keys/scene_reference.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/schema.hpp"
#include "tests/helpers/paths.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace pulvis {
namespace {

std::string committed(const std::string& name) {
  std::ifstream file(paths::source_dir() + "/docs/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Reference, TheMarkdownIsCurrent) { EXPECT_EQ(committed("scene.md"), scene_reference()); }

TEST(Reference, TheJsonSchemaIsCurrent) {
  EXPECT_EQ(committed("scene.schema.json"), scene_json_schema());
}

TEST(Reference, EveryKeyIsInBoth) {
  const std::string markdown = scene_reference();
  const std::string json = scene_json_schema();
  for (const schema::TableView& view : schema::scene_language()) {
    for (const schema::KeyInfo& key : view.keys) {
      EXPECT_NE(markdown.find("| `" + key.name + "` |"), std::string::npos) << key.name;
      EXPECT_NE(json.find('"' + key.name + '"'), std::string::npos) << key.name;
      EXPECT_FALSE(key.doc.empty()) << key.name;
    }
  }
}

TEST(Reference, TheSchemaForbidsKeysOfTheOtherOutline) {
  const auto json = nlohmann::json::parse(scene_json_schema());
  const auto& particle = json["properties"]["particle"]["items"];
  EXPECT_EQ(particle["additionalProperties"], false);
  const auto& disc = particle["allOf"][0];
  EXPECT_EQ(disc["if"]["properties"]["outline"]["const"], "disc");
  EXPECT_EQ(disc["then"]["properties"]["width"], false);
  EXPECT_EQ(disc["then"]["properties"]["mesh"]["properties"]["columns"], false);
  const auto& whole = json["$defs"]["two-dimensions"]["properties"]["particle"]["items"];
  EXPECT_EQ(whole["allOf"][0]["then"]["required"], nlohmann::json::array({"diameter"}));
}

TEST(Reference, TheSchemaKeepsTheDimensionsApart) {
  const auto json = nlohmann::json::parse(scene_json_schema());
  const auto position = [](const nlohmann::json& scene) {
    const auto& body = scene["properties"]["body"]["items"]["properties"]["position"];
    return std::pair(body["minItems"], body["maxItems"]);
  };
  EXPECT_EQ(position(json), std::pair(nlohmann::json(2), nlohmann::json(3)));
  EXPECT_EQ(position(json["$defs"]["two-dimensions"]),
            std::pair(nlohmann::json(2), nlohmann::json(2)));
  EXPECT_EQ(position(json["$defs"]["three-dimensions"]),
            std::pair(nlohmann::json(3), nlohmann::json(3)));
  const auto& particle =
      json["$defs"]["three-dimensions"]["properties"]["particle"]["items"]["properties"];
  EXPECT_TRUE(particle.contains("shape"));
  EXPECT_FALSE(particle.contains("outline"));
}

TEST(Reference, TheReferenceSaysWhereAKeyExists) {
  const std::string markdown = scene_reference();
  for (const char* row : {"| `thickness` | 2D |", "| `seed` | 2D, 3D |", "| `axis` | 3D |",
                          "| `angle` | 2D |", "| `angle` | 3D |"})
    EXPECT_NE(markdown.find(row), std::string::npos) << row;
}

TEST(Reference, TheSchemaRequiresKeysWhereNothingIsExtended) {
  const auto json = nlohmann::json::parse(scene_json_schema());
  EXPECT_EQ(json["if"]["not"]["required"], nlohmann::json::array({"extends"}));
  EXPECT_EQ(json["then"]["else"]["$ref"], "#/$defs/two-dimensions");
  EXPECT_EQ(json["then"]["then"]["$ref"], "#/$defs/three-dimensions");
  for (const char* whole : {"two-dimensions", "three-dimensions"})
    EXPECT_EQ(json["$defs"][whole]["required"], nlohmann::json::array({"family", "material"}));
  EXPECT_FALSE(json.contains("required"));
  EXPECT_FALSE(json["properties"]["particle"]["items"].contains("required"));
}

}  // namespace
}  // namespace pulvis

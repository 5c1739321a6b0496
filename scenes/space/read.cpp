#include "scenes/space/read.hpp"

#include <fmt/format.h>

#include "scenes/keys/scene_tables.hpp"
#include "scenes/space/keys/tables.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {
namespace {

using document::Array;
using document::Table;
using document::Value;

class SpaceReader : public SceneTables {
 public:
  SpaceReader(const Table& root, Problems& problems)
      : SceneTables(root, problems, scene_language()) {}

  Scene read(const std::filesystem::path& file) {
    Scene scene;
    scene.file = file;
    scene.space = std::make_shared<SpaceScene>();
    SpaceScene& space = *scene.space;
    tables_.read(language::top_level(), Value{root_, {{1, 1}, -1}}, "", "", scene);
    scene.materials = read_materials();
    space.particles = read_particles();
    space.bodies = read_all(language::body());
    space.packings = read_packings();
    space.tools = read_all(language::tool());
    scene.stages = read_stages(space);
    scene.frictions = read_all(schema::friction());
    scene.bonds = read_all(language::bond());
    read_one(language::contact(), scene.contact);
    read_one(language::element(), space);
    read_one(language::time(), scene.time);
    read_one(language::output(), scene.output);
    read_one(schema::limits(), scene.limits);
    scene.expects = read_all(schema::expect());
    return scene;
  }

 private:
  std::vector<ParticleSpec> read_particles() {
    std::vector<ParticleSpec> particles = read_all(language::particle());
    const Array& elements = array_at("particle");
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const document::Entry* mesh = document::find(table, "mesh");
      const std::string* shape = document::find_text(table, "shape");
      if (mesh != nullptr && shape != nullptr && is_shape(*shape))
        tables_.read(language::mesh(), mesh->value, numbered("particle", i) + ".mesh", *shape,
                     particles[i]);
    }
    return particles;
  }

  // A misspelt shape is reported once; the keys of its mesh cannot be checked then.
  static bool is_shape(const std::string& shape) {
    const schema::KeyInfo& key =
        *schema::find_key(*schema::find_table("particle", scene_language()), "shape");
    for (const schema::Choice& choice : key.choices)
      if (choice.word == shape) return true;
    return false;
  }

  std::vector<PackingSpec> read_packings() {
    std::vector<PackingSpec> packings = read_all(language::packing());
    const Array& elements = array_at("packing");
    for (std::size_t i = 0; i < packings.size(); ++i)
      packings[i].classes = read_elements(language::mixture_class(), elements[i].get<Table>(),
                                          numbered("packing", i));
    return packings;
  }

  std::vector<StageSpec> read_stages(SpaceScene& space) {
    std::vector<StageSpec> stages = read_all(language::stage());
    const Array& elements = array_at("stage");
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const std::string path = numbered("stage", i);
      space.moves.push_back(read_elements(language::move(), table, path));
      space.servos.push_back(read_elements(language::servo(), table, path));
      read_until(language::until(), table, path, stages[i]);
    }
    return stages;
  }
};

}  // namespace

Scene read_tree(const Table& root, const std::filesystem::path& file, Problems& problems,
                schema::Origins& origins) {
  SpaceReader reader(root, problems);
  Scene scene = reader.read(file);
  origins = reader.origins();
  return scene;
}

}  // namespace pulvis::space

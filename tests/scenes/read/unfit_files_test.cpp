// Files that scenes name: every key that names one refuses a pipe, which would wait for a writer, and a device, which
// would never end. The keys are found by their declarations, in the scenes that test all keys.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "scenes/keys/tables.hpp"
#include "scenes/language/named_files.hpp"
#include "scenes/language/scene_text.hpp"
#include "scenes/read.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

using UnfitFiles = ProgramTest;

std::vector<fs::path> scenes_of_all_keys() {
  std::vector<fs::path> files;
  for (const char* folder : {"scenes", "scenes-3d"})
    for (const auto& entry :
         fs::directory_iterator(fs::path(paths::source_dir()) / "tests" / "keys" / folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

// The scene with its path number `which` led to `unfit`, with the extension of the file that it names; empty if it has no
// such path. The others become absolute.
std::string with_path(const fs::path& file, int which, const fs::path& unfit) {
  document::Table root = document::parse(toml_file_text(file));
  int number = 0;
  const schema::Language& language = language_of(root);
  for_each_path(root, language, [&](schema::Kind, std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    path = number++ == which ? unfit.string() + extension : (file.parent_path() / path).string();
  });
  if (which >= number) return "";
  // Variables are not part of the text of a complete scene.
  const document::Entry* let = document::find(root, "let");
  const document::Table variables =
      let == nullptr ? document::Table() : let->value.get<document::Table>();
  std::erase_if(root, [](const document::Entry& entry) { return entry.key == "let"; });
  std::string text = scene_text(root, language);
  if (!variables.empty()) text += "[let]\n";
  for (const document::Entry& variable : variables)
    text += variable.key + " = " + document::value_text(variable.value) + "\n";
  return text;
}

TEST_F(UnfitFiles, AreRefusedWhereverTheyAreNamed) {
  const fs::path pipe = place / "pipe", zero = place / "zero";
  for (const char* extension :
       {"", ".toml", ".csv", ".svg", ".dxf", ".stl", ".msh", ".gsf", ".h5"}) {
    ASSERT_EQ(mkfifo((pipe.string() + extension).c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", zero.string() + extension);
  }
  alarm(120);  // a reader that waits ends the test
  int paths = 0;
  for (const fs::path& file : scenes_of_all_keys())
    for (int which = 0; !with_path(file, which, pipe).empty(); ++which) {
      SCOPED_TRACE(file.filename().string() + ", path " + std::to_string(which));
      const auto refusal = [&](const fs::path& unfit) {
        return message_of(
            [&] { load_scene_text(with_path(file, which, unfit), place / "scene.toml"); });
      };
      EXPECT_THAT(refusal(pipe), AnyOf(HasSubstr("is a named pipe"), HasSubstr("is not a file")));
      EXPECT_THAT(refusal(zero), AnyOf(HasSubstr("is a device"), HasSubstr("is not a file")));
      ++paths;
    }
  alarm(0);
  EXPECT_GT(paths, 20);
}

}  // namespace
}  // namespace pulvis

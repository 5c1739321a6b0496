// Scripts in Python that the program carries: put into a folder, started, and what they drew put into its place.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pulvis {

// A folder for the scripts whose names begin like this, gone when the pictures are drawn.
class ScriptFolder {
 public:
  explicit ScriptFolder(std::string_view beginning);
  ScriptFolder(const ScriptFolder&) = delete;
  ScriptFolder& operator=(const ScriptFolder&) = delete;
  ~ScriptFolder();

  // Of the pictures, until they are put in their places.
  std::filesystem::path drawn() const;

  std::filesystem::path path;
};

// Its exit code. Debian's own python has the modules of Debian's packages; elsewhere the first on the path.
int run_python(const std::vector<std::string>& words);

// Each line of the list in the folder of what was drawn: a file's name there, and where it belongs. No other than an own file
// is replaced. Tells what it wrote.
void put_in_place(const std::filesystem::path& drawn);

}  // namespace pulvis

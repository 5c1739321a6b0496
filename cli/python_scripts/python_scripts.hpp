// Python scripts embedded in the program: written to a folder, run, and their pictures moved into place.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pulvis {

// A folder for the scripts whose names begin with this prefix, removed once the pictures are drawn.
class ScriptFolder {
 public:
  explicit ScriptFolder(std::string_view beginning);
  ScriptFolder(const ScriptFolder&) = delete;
  ScriptFolder& operator=(const ScriptFolder&) = delete;
  ~ScriptFolder();

  // Holds the pictures until they are moved into place.
  std::filesystem::path drawn() const;

  std::filesystem::path path;
};

// Returns its exit code. Debian's own python has the modules of Debian's packages; elsewhere the first one on PATH.
int run_python(const std::vector<std::string>& words);

// Each line of the list in the folder of drawn pictures: a file's name there, and its destination. Only Pulvis's own files
// are replaced. Reports what it wrote.
void put_in_place(const std::filesystem::path& drawn);

}  // namespace pulvis

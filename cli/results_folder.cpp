#include "cli/results_folder.hpp"

#include <fmt/format.h>

#include "scenes/language/problem.hpp"

namespace pulvis {

std::filesystem::path results_folder(const std::filesystem::path& given,
                                     const std::filesystem::path& file) {
  if (!given.empty()) return given;
  const std::filesystem::path name = file.stem();
  if (name.empty() || name == "." || name == "..")
    throw SceneError({{file.string(), 1, 1, "", "output",
                       fmt::format("the results would go to runs/{}, allowed: -o FOLDER, or a file "
                                   "name that begins with more than dots",
                                   name.string())}});
  return std::filesystem::path("runs") / name;
}

}  // namespace pulvis

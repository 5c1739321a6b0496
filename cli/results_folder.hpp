// The folder of results that are given none: runs/<name of the file>.
#pragma once

#include <filesystem>

namespace pulvis {

// `given` unless it is empty. Throws SceneError for a file whose name leads elsewhere: "..toml" to runs/ itself,
// "...toml" out of it.
std::filesystem::path results_folder(const std::filesystem::path& given,
                                     const std::filesystem::path& file);

}  // namespace pulvis

// Opens files named by a user: only regular ones (links are followed) of limited size. A pipe would wait for a
// writer, and a device would never end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace pulvis {

// Its message says what is wrong with the path: "is a folder", "there is no such file".
class UnfitInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void require_regular_file(
    const std::filesystem::path& path);  // for libraries that open it themselves
std::string text_of_input(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace pulvis

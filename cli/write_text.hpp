// A small text file, written as a whole or an OutputError.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/output_error.hpp"

namespace pulvis {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw OutputError(path, "write", std::strerror(errno));
}

}  // namespace pulvis

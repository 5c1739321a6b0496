#include "cli/write_text.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/output_error.hpp"

namespace pulvis {

void write_text(const std::filesystem::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OutputError(path, "write", std::strerror(errno));
}

}  // namespace pulvis

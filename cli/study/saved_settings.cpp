#include "cli/study/saved_settings.hpp"

#include <fstream>
#include <sstream>

#include "cli/study/study_runner.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  std::ifstream stream(file, std::ios::binary);
  bytes << stream.rdbuf();
  if (!stream) throw OutputError(file, "keep a copy of it", "it cannot be read");
  return std::move(bytes).str();
}

bool has_bytes(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  return fs::is_regular_file(file, error) && bytes_of(file) == bytes;
}

}  // namespace

void save_settings(const fs::path& file, const char* role, const WholeSettings& settings) {
  for (const InputFile& input : settings.inputs) {
    const fs::path target = file.parent_path() / input.copy;
    const std::string bytes = input.text ? *input.text : bytes_of(input.source);
    if (has_bytes(target, bytes)) continue;
    make_folder(target.parent_path());
    write_own(target, role, bytes);
  }
  write_own(file, role, settings.text);
}

}  // namespace pulvis

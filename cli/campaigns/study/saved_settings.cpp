#include "cli/campaigns/study/saved_settings.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "cli/campaigns/study/study_runner.hpp"
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

// Removes copies made for an earlier version of the settings, and their folders.
void remove_others(const fs::path& folder, const char* role, const std::set<fs::path>& kept) {
  std::error_code none;
  if (!fs::is_directory(fs::symlink_status(folder, none))) return;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path());
  for (const fs::path& file : files)
    if (fs::is_directory(fs::symlink_status(file, none)))
      remove_others(file, role, kept);
    else if (!kept.contains(file))
      remove_own(file, role);
  const bool is_kept =
      std::ranges::any_of(files, [&](const fs::path& file) { return kept.contains(file); });
  if (!is_kept) remove_own_below(folder, role);
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
  const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path());
  std::set<fs::path> kept;
  for (const InputFile& input : settings.inputs) {
    kept.insert(folder / input.copy);
    kept.insert(input.source);  // it may be one of them, and runs will read it
  }
  remove_others(folder / "inputs", role, kept);
  write_own(file, role, settings.text);
}

}  // namespace pulvis

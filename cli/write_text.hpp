// A whole text file at once; throws OutputError where that does not work.
#pragma once

#include <filesystem>
#include <string>

namespace pulvis {

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace pulvis

// Assembles a page of cli/report/report/ into one file: embedded style, scripts and data, no loading.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/report/report_data.hpp"

namespace pulvis {

// `page`, inserted between head.html and tail.html, and `scripts` are names of assets; the data go into
// elements that payload.js reads. `of`: owner of the page (engine/files/own_files.hpp).
void write_page(const std::filesystem::path& path, const char* page,
                const std::vector<std::string>& scripts, const ReportData& data, const char* of);

enum class Loads { nothing, from_its_server };  // of a page, after it has been opened
std::string page_text(const char* page, const std::vector<std::string>& scripts,
                      const ReportData& data, Loads loads = Loads::nothing);

}  // namespace pulvis

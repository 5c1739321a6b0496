// A page of cli/report/report/ made into one file: style, scripts and data put in, nothing loaded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/report/report_data.hpp"

namespace pulvis {

// `page`, which stands between head.html and tail.html, and `scripts` are names of assets; the data go into
// elements that payload.js reads. `of`: what the page belongs to (engine/files/own_files.hpp).
void write_page(const std::filesystem::path& path, const char* page,
                const std::vector<std::string>& scripts, const ReportData& data, const char* of);

}  // namespace pulvis

// Run data embedded in report.html: a head (JSON: names, units, ranges) and packed numbers, small enough
// in total to be sent by e-mail (at most about 15 MB).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct ReportSection {
  std::string name;  // "cells", "history", "frame-3-position", "frame-3-0" (field 0 of frame 3)
  std::string text;  // encoded as in cli/report/report_encoding
};

struct ReportData {
  std::string title;
  std::string head;  // JSON
  std::vector<ReportSection> sections;
  bool in_space = false;  // particles in three dimensions
};

ReportData read_report_data(const std::filesystem::path& run_folder);

// Several runs for one page: the head lists them as "runs"; names of their sections begin with "run-0-",
// "run-1-" and so on.
ReportData read_comparison(const std::vector<std::filesystem::path>& run_folders);

}  // namespace pulvis

// What report.html carries of a run: a head (JSON: names, units, ranges) and packed numbers.
//
// Frames are thinned evenly, the last one always kept, so that the file stays small enough to mail:
// about 15 MB for a hundred particles of 141 quads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct ReportSection {
  std::string name;  // "quads", "history", "frame-3-position", "frame-3-0" (field 0 of frame 3)
  std::string text;  // as cli/report_encoding writes it
};

struct ReportData {
  std::string title;
  std::string head;  // JSON
  std::vector<ReportSection> sections;
};

ReportData read_report_data(const std::filesystem::path& run_folder);

}  // namespace pulvis

// pulvis preview: the set-up of a scene, drawn and labelled before it runs. What is drawn is written as JSON; the scripts
// of the package pulvis.preview, which the program carries, draw it. They need python3 with numpy and matplotlib.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct PreviewOptions {
  std::filesystem::path scene;
  std::filesystem::path output = "preview.png";  // .png .svg .pdf, or .json: what would be drawn
  std::vector<std::string> overrides;
};

ExitCode draw_preview(const PreviewOptions& options);

}  // namespace pulvis

// pulvis preview: draws and labels the set-up of a scene before it runs. The drawing data are written as JSON; scripts
// of the package pulvis.preview, embedded in the program, draw them. They need python3 with numpy and matplotlib.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct PreviewOptions {
  std::filesystem::path scene;
  std::filesystem::path output = "preview.png";  // .png .svg .pdf, or .json: the drawing data
  std::vector<std::string> overrides;
};

ExitCode draw_preview(const PreviewOptions& options);

}  // namespace pulvis

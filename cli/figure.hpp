// `pulvis figure`: pictures and tables of a run for papers, drawn by the package pulvis.figures
// (cli/python), which is embedded in the program. It needs python3 with h5py and matplotlib.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct FigureOptions {
  std::filesystem::path folder;
  std::filesystem::path output;  // a file, or a folder for all figures; empty: pictures/ in the run
  std::string field;
  std::optional<int> frame;
  std::vector<std::string> series;
  std::string against;
  std::string format = "png";       // of all figures
  std::string level = "none";       // for raster images
  std::filesystem::path animation;  // .mp4 or .gif of all frames; empty: none
  // As given on the command line; empty: not given.
  std::string width, height, colours, range, dpi;
  std::string across, at;  // in three dimensions: axis and position of sections
  bool no_title = false;
};

ExitCode draw_figures(const FigureOptions& options);

}  // namespace pulvis

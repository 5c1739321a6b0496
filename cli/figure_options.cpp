#include "cli/figure_options.hpp"

#include "cli/options.hpp"

namespace pulvis {
namespace {

// Options that change the look of a figure; the scripts refuse values that are not allowed.
void add_look(CLI::App& command, FigureOptions& options) {
  command.add_option(
      "--width", options.width,
      "width of every figure in mm, cm, in or pt, e.g. 85mm (default: depends on the figure)");
  command.add_option("--height", options.height, "height of every figure, e.g. 60mm");
  command.add_flag("--no-title", options.no_title, "no titles above the figures");
  command.add_option(
      "--cmap", options.colours,
      "colour map for continuous values: a name of matplotlib, e.g. cividis or magma_r");
  command.add_option(
      "--range", options.range,
      "colour range of the field as LOW:HIGH, e.g. 0:400MPa; either end may be omitted. frame: "
      "density maps are each scaled by their own frame");
  command.add_option("--dpi", options.dpi, "resolution of a PNG in dots per inch (default 200)");
  command
      .add_option("--animate", options.animation,
                  "animate the field over all frames; output file .mp4 or .gif (MP4 needs ffmpeg)")
      ->transform(without_detours);
}

}  // namespace

void add_figure(CLI::App& app, FigureOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "figure",
      "draw figures of a run for publication (PNG, SVG, PDF), or export their data (CSV)");
  command->add_option("folder", options.folder, "results folder of a run, a study or a probe")
      ->required();
  command->add_option("--field", options.field,
                      "draw this particle field; name:2 selects its second component");
  command->add_option("--frame", options.frame,
                      "frame number, starting at 0 (default: the last frame)");
  command
      ->add_option("--series", options.series,
                   "draw this history series; repeat the option to overlay several")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--against", options.against,
                      "series on the horizontal axis (default: time)");
  command
      ->add_option("-o,--output", options.output,
                   "output file (.png, .svg, .pdf, .csv or .xyz); without --field and --series a "
                   "folder for all figures (default: pictures/ in the run's folder)")
      ->transform(without_detours);
  command
      ->add_option(
          "--format", options.format,
          "format of all figures: png, svg, pdf or csv; gsf: raster images for Gwyddion; xyz: "
          "the particles of all frames for OVITO")
      ->check(CLI::IsMember({"png", "svg", "pdf", "csv", "gsf", "xyz"}));
  command
      ->add_option("--level", options.level,
                   "levelling of raster images: none, plane, or lines (the median of each line is "
                   "subtracted)")
      ->check(CLI::IsMember({"none", "plane", "lines"}));
  command
      ->add_option("--across", options.across,
                   "3D only: axis normal to sections and density maps (default y)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command->add_option(
      "--at", options.at,
      "position of the section along that axis, e.g. 2mm (default: near the middle)");
  add_look(*command, options);
  command->callback([&] { code = draw_figures(options); });
}

}  // namespace pulvis

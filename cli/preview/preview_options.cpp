#include "cli/preview/preview_options.hpp"

namespace pulvis {
namespace {

const CLI::Validator picture_name(
    [](const std::string& name) {
      const std::string ending = std::filesystem::path(name).extension().string();
      for (const char* known : {".png", ".svg", ".pdf", ".json"})
        if (ending == known) return std::string();
      return "'" + name + "' does not end in .png, .svg, .pdf or .json";
    },
    "FILE", "picture_name");

}  // namespace

void add_preview(CLI::App& app, PreviewOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "preview",
      "draw the set-up of a scene before it runs: die, tools, particles and stages, or the lever");
  command->add_option("scene", options.scene, "scene file (TOML)")->required();
  command
      ->add_option("-o,--output", options.output,
                   "output file: .png, .svg or .pdf, or .json with the data of the drawing in SI "
                   "units (default preview.png)")
      ->transform(without_detours)
      ->check(picture_name);
  add_overrides(*command, options.overrides, "this picture");
  command->callback([&options, &code] { code = draw_preview(options); });
}

}  // namespace pulvis

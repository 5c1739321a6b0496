#include "cli/report/report_images.hpp"

#include <algorithm>

#include "cli/report/report_encoding.hpp"

namespace pulvis {
namespace {

constexpr std::size_t most_pixels = 512;  // along each side

std::vector<float> thinned_image(const std::vector<double>& values, std::size_t pixels,
                                 std::size_t stride) {
  std::vector<float> kept;
  const std::size_t lines = values.size() / pixels;
  for (std::size_t line = 0; line < lines; line += stride)
    for (std::size_t pixel = 0; pixel < pixels; pixel += stride)
      kept.push_back(static_cast<float>(values[line * pixels + pixel]));
  return kept;
}

}  // namespace

void add_images(const hdf5::File& file, nlohmann::ordered_json& head,
                std::vector<ReportSection>& sections) {
  if (!file.contains("/images")) return;
  for (const std::string& name : file.datasets_below("/images")) {
    const std::string dataset = "/images/" + name;
    const auto shape = file.shape(dataset);
    if (shape.size() != 2 || shape[0] * shape[1] == 0) continue;
    const std::size_t lines = shape[0], pixels = shape[1];
    const std::size_t stride = 1 + (std::max(lines, pixels) - 1) / most_pixels;
    nlohmann::ordered_json image{{"name", name},
                                 {"unit", file.text_attribute(dataset, "unit")},
                                 {"lines", (lines - 1) / stride + 1},
                                 {"pixels", (pixels - 1) / stride + 1},
                                 {"stride", stride}};
    if (file.has_attribute(dataset, "pixel_width")) {
      const auto steps = static_cast<double>(stride);
      image["pixel_width"] = steps * file.number_attribute(dataset, "pixel_width");
      image["pixel_height"] = steps * file.number_attribute(dataset, "pixel_height");
    }
    sections.push_back({"image-" + std::to_string(head["images"].size()),
                        encoded(thinned_image(file.read_doubles(dataset), pixels, stride))});
    head["images"].push_back(std::move(image));
  }
}

}  // namespace pulvis

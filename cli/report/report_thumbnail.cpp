#include "cli/report/report_thumbnail.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_frames.hpp"
#include "cli/report/report_mesh.hpp"
#include "cli/report/report_solid.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::size_t thumbnail_cells = 60'000, fan_sectors = 16;
constexpr int largest_side = 240, smallest_side = 48;
constexpr int colours_used = 250;  // of the palette; entry 0 is transparent background
constexpr double share_left_out = 0.01;
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

// Viridis (van der Walt & Smith), as in maps.js.
constexpr std::array<std::array<int, 3>, 11> viridis{{{68, 1, 84},
                                                      {72, 36, 117},
                                                      {65, 68, 135},
                                                      {53, 95, 141},
                                                      {42, 120, 142},
                                                      {33, 145, 140},
                                                      {34, 168, 132},
                                                      {68, 191, 112},
                                                      {122, 209, 81},
                                                      {189, 223, 38},
                                                      {253, 231, 37}}};

// Polygons in painting order.
struct Drawing {
  struct Polygon {
    std::array<std::array<double, 2>, 4> corners{};  // m
    double value = 0;                                // of the field
  };

  std::vector<Polygon> polygons;
  std::string field, unit;
};

void add_word(Bytes& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<unsigned char>(word >> shift & 255U));
}

void add_chunk(Bytes& png, const char* type, const Bytes& data) {
  add_word(png, static_cast<std::uint32_t>(data.size()));
  Bytes body(type, type + 4);
  body.insert(body.end(), data.begin(), data.end());
  png.insert(png.end(), body.begin(), body.end());
  add_word(png,
           static_cast<std::uint32_t>(crc32(0L, body.data(), static_cast<unsigned>(body.size()))));
}

Bytes palette() {
  Bytes rgb{255, 255, 255};
  for (int i = 0; i < colours_used; ++i) {
    const double at = i * (viridis.size() - 1.0) / (colours_used - 1);
    const auto below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
    for (std::size_t k = 0; k < 3; ++k)
      rgb.push_back(static_cast<unsigned char>(
          std::lround(viridis[below][k] + (at - static_cast<double>(below)) *
                                              (viridis[below + 1][k] - viridis[below][k]))));
  }
  return rgb;
}

Bytes png_of(int width, int height, const Bytes& pixels) {
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, head, rows;
  add_word(head, static_cast<std::uint32_t>(width));
  add_word(head, static_cast<std::uint32_t>(height));
  head.insert(head.end(), {8, 3, 0, 0, 0});  // one byte per pixel, indexed colour
  for (int row = 0; row < height; ++row) {
    rows.push_back(0);  // no filter
    const auto begin = pixels.begin() + static_cast<std::ptrdiff_t>(row) * width;
    rows.insert(rows.end(), begin, begin + width);
  }
  add_chunk(png, "IHDR", head);
  add_chunk(png, "PLTE", palette());
  add_chunk(png, "tRNS", {0});
  add_chunk(png, "IDAT", deflated(rows));
  add_chunk(png, "IEND", {});
  return png;
}

using Corners = std::array<std::array<double, 2>, 4>;  // in pixels

// Fills pixels whose centre lies inside.
void fill(Thumbnail& picture, const Corners& at, float value) {
  const auto [low, high] = std::minmax({at[0][1], at[1][1], at[2][1], at[3][1]});
  const int first = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
  const int last = std::min(picture.height - 1, static_cast<int>(std::floor(high - 0.5)));
  for (int row = first; row <= last; ++row) {
    std::array<double, 4> crossings;
    crossings.fill(std::numeric_limits<double>::infinity());  // unused entries sort last
    std::size_t count = 0;
    const double y = row + 0.5;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto &a = at[k], &b = at[(k + 1) % 4];
      if ((a[1] <= y) != (b[1] <= y))
        crossings[count++] = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    }
    std::ranges::sort(crossings);
    for (std::size_t k = 0; k + 1 < count; k += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil(crossings[k] - 0.5)));
      const int to =
          std::min(picture.width - 1, static_cast<int>(std::ceil(crossings[k + 1] - 0.5)) - 1);
      for (int column = from; column <= to; ++column)
        picture.pixels[static_cast<std::size_t>(row * picture.width + column)] = value;
    }
  }
}

// Range of the field, ignoring a hundredth of the polygons at either end.
Range range_of(const Drawing& drawing) {
  std::vector<double> values;
  for (const Drawing::Polygon& one : drawing.polygons)
    if (std::isfinite(one.value)) values.push_back(one.value);
  if (values.empty()) return {};
  const auto at = [&](double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, place);
    return *place;
  };
  const double low = at(share_left_out);
  return {low, at(1 - share_left_out)};
}

// The first of these fields that the frame has.
std::string field_of(const hdf5::File& file, const std::string& frame) {
  for (const char* name : {"plastic_strain", "effective_stress", "pressure"})
    if (file.contains(frame + "/" + name)) return name;
  return {};
}

Drawing plane_drawing(const hdf5::File& file, const std::string& frame) {
  const PlaneMesh mesh{file.read_integers("/mesh/quads"), file.read_integers("/mesh/cell_particle"),
                       file.read_integers("/mesh/node_particle"),
                       file.read_doubles("/mesh/reference")};
  const DrawnMesh drawn =
      mesh.cells() > thumbnail_cells ? DrawnMesh::fans(mesh, fan_sectors) : DrawnMesh::whole(mesh);
  const ReportCell<TwoD> cell{file, frame, mesh.node_particle};
  const auto xy = drawn.positions(cell.inside(file.read_doubles(frame + "/position")));
  Drawing drawing;
  std::vector<double> values(drawn.cell_count(), 0.0);
  if (const std::string field = field_of(file, frame); !field.empty()) {
    drawing.field = field;
    drawing.unit = file.text_attribute(frame + "/" + field, "unit");
    values = drawn.values(file.read_doubles(frame + "/" + field));
  }
  for (std::size_t c = 0; c < drawn.cell_count(); ++c) {
    Drawing::Polygon one{{}, values[c]};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = 2 * static_cast<std::size_t>(drawn.cells()[4 * c + k]);
      one.corners[k] = {xy[node], xy[node + 1]};
    }
    drawing.polygons.push_back(one);
  }
  return drawing;
}

// Oblique view; displacements are exaggerated, the largest to an eighth of the size.
class SolidView {
 public:
  SolidView(std::vector<double> reference, std::vector<double> position)
      : reference_(std::move(reference)), position_(std::move(position)) {
    double largest = 0, low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
      largest = std::max(largest, std::abs(position_[i] - reference_[i]));
      low = std::min(low, reference_[i]);
      high = std::max(high, reference_[i]);
    }
    if (largest > 0) larger_ = std::max(1.0, (high - low) / 8 / largest);
  }

  // x and y in the picture, then the depth.
  std::array<double, 3> place(std::size_t node) const {
    constexpr double turn = -0.7, tilt = 0.5;  // rad
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = reference_[3 * node + k];
      p[k] = from + larger_ * (position_[3 * node + k] - from);
    }
    const double across = p[0] * std::cos(turn) - p[1] * std::sin(turn);
    const double away = p[0] * std::sin(turn) + p[1] * std::cos(turn);
    return {across, away * std::sin(tilt) + p[2] * std::cos(tilt),
            away * std::cos(tilt) - p[2] * std::sin(tilt)};
  }

  double displacement(std::size_t node) const {
    double square = 0;
    for (std::size_t k = 3 * node; k < 3 * node + 3; ++k)
      square += (position_[k] - reference_[k]) * (position_[k] - reference_[k]);
    return std::sqrt(square);
  }

 private:
  std::vector<double> reference_, position_;
  double larger_ = 1;
};

Drawing solid_drawing(const hdf5::File& file, const std::string& frame) {
  const std::vector<std::int32_t> faces = surface_faces(file);
  const SolidView view(file.read_doubles("/mesh/reference"),
                       file.read_doubles(frame + "/position"));
  Drawing drawing;
  drawing.field = "displacement";
  drawing.unit = "m";
  std::vector<double> depth;
  for (std::size_t f = 0; f + 3 < faces.size(); f += 4) {
    Drawing::Polygon one;
    double away = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = static_cast<std::size_t>(faces[f + k]);
      const auto [x, y, z] = view.place(node);
      one.corners[k] = {x, y};
      one.value += view.displacement(node) / 4;
      away += z / 4;
    }
    depth.push_back(away);
    drawing.polygons.push_back(one);
  }
  std::vector<std::size_t> order(depth.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, std::greater<>(), [&](std::size_t i) { return depth[i]; });
  std::vector<Drawing::Polygon> sorted;
  for (const std::size_t i : order) sorted.push_back(drawing.polygons[i]);
  drawing.polygons = std::move(sorted);
  return drawing;
}

}  // namespace

std::optional<Thumbnail> thumbnail_of(const std::filesystem::path& run_h5, int side) {
  std::error_code ignored;
  if (!std::filesystem::exists(run_h5, ignored)) return {};
  const auto file = hdf5::File::open(run_h5);
  const auto names = complete_frames(file);
  if (names.empty()) return {};
  const std::string frame = "/frames/" + names.back();
  const Drawing drawing =
      file.contains("/mesh/hexahedra") ? solid_drawing(file, frame) : plane_drawing(file, frame);
  Range x{INFINITY, -INFINITY}, y = x;
  for (const Drawing::Polygon& one : drawing.polygons)
    for (const auto& corner : one.corners) {
      x = {std::min(x.low, corner[0]), std::max(x.high, corner[0])};
      y = {std::min(y.low, corner[1]), std::max(y.high, corner[1])};
    }
  const double scale = side / std::max(x.high - x.low, y.high - y.low);
  if (!(scale > 0 && std::isfinite(scale))) return {};
  const auto pixels = [&](const Range& range) {
    return std::max(1, static_cast<int>(std::lround((range.high - range.low) * scale)));
  };
  Thumbnail thumbnail{pixels(x), pixels(y), {}, drawing.field, drawing.unit, range_of(drawing)};
  thumbnail.pixels.assign(static_cast<std::size_t>(thumbnail.width * thumbnail.height), nothing);
  for (const Drawing::Polygon& one : drawing.polygons) {
    Corners at{};
    for (std::size_t k = 0; k < 4; ++k)
      at[k] = {(one.corners[k][0] - x.low) * scale, (y.high - one.corners[k][1]) * scale};
    fill(thumbnail, at, std::isfinite(one.value) ? static_cast<float>(one.value) : 0.0F);
  }
  return thumbnail;
}

std::string thumbnail_png(const Thumbnail& thumbnail, const Range& colours) {
  const double width = colours.high - colours.low;
  Bytes codes;
  for (const float value : thumbnail.pixels) {
    const double share = width > 0 ? (value - colours.low) / width : 0;
    codes.push_back(std::isnan(value)
                        ? static_cast<unsigned char>(0)
                        : static_cast<unsigned char>(
                              1 + std::lround((colours_used - 1) * std::clamp(share, 0.0, 1.0))));
  }
  return "data:image/png;base64," + base64(png_of(thumbnail.width, thumbnail.height, codes));
}

int thumbnail_side(std::size_t count, std::size_t budget) {
  if (count == 0) return 0;
  const double side = std::sqrt(static_cast<double>(budget / count));
  return side < smallest_side ? 0 : std::min(largest_side, static_cast<int>(side));
}

}  // namespace pulvis

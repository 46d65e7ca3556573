#include "gathering/gather_picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "points/file_bytes.hpp"

namespace berm::app {
namespace {

constexpr int kLongSide = 1000;
using Colour = std::array<std::uint8_t, 3>;

// The place of a share of the points along one axis.
double place_of_share(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

Colour colour_of(double share) {  // blue, green, red
  const auto channel = [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 210.0); };
  return {channel(2.0 * share - 1.0), channel(1.0 - std::abs(2.0 * share - 1.0)), channel(1.0 - 2.0 * share)};
}

}  // namespace

double write_cloud_picture(const std::string& path, const std::vector<ScanPoint>& points, PictureView view) {
  double low_z = 0.0, high_z = 1.0;
  if (!points.empty()) {
    std::vector<float> x, y, z;
    for (const ScanPoint& p : points) {
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
    }
    low_z = place_of_share(z, 0.01);
    high_z = std::max(low_z + 1e-3, place_of_share(z, 0.99));
    if (view.high_x <= view.low_x || view.high_y <= view.low_y) {
      view = {place_of_share(x, 0.01), place_of_share(y, 0.01), place_of_share(x, 0.99), place_of_share(y, 0.99)};
      const double margin = 0.05 * std::max({view.high_x - view.low_x, view.high_y - view.low_y, 0.1});
      view = {view.low_x - margin, view.low_y - margin, view.high_x + margin, view.high_y + margin};
    }
  }
  if (view.high_x <= view.low_x || view.high_y <= view.low_y) view = {-1.0, -1.0, 1.0, 1.0};
  const double span_x = view.high_x - view.low_x, span_y = view.high_y - view.low_y, scale = kLongSide / std::max(span_x, span_y);
  const int width = std::max(16, static_cast<int>(std::ceil(span_x * scale))), height = std::max(16, static_cast<int>(std::ceil(span_y * scale)));
  std::vector<Colour> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Colour{255, 255, 255});
  const auto set = [&](int column, int row, const Colour& colour) {
    if (column >= 0 && row >= 0 && column < width && row < height)
      pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] = colour;
  };
  const auto column_of = [&](double v) { return static_cast<int>(std::floor((v - view.low_x) * scale)); };
  const auto row_of = [&](double v) { return height - 1 - static_cast<int>(std::floor((v - view.low_y) * scale)); };
  const double step = std::pow(10.0, std::floor(std::log10(std::max(span_x, span_y) * 0.5)));
  for (double v = std::ceil(view.low_x / step) * step; v <= view.high_x; v += step)
    for (int row = 0; row < height; ++row) set(column_of(v), row, {215, 215, 215});
  for (double v = std::ceil(view.low_y / step) * step; v <= view.high_y; v += step)
    for (int column = 0; column < width; ++column) set(column, row_of(v), {215, 215, 215});
  for (const ScanPoint& p : points) {
    const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
    if (!(x >= view.low_x && x <= view.high_x && y >= view.low_y && y <= view.high_y)) continue;
    const Colour colour = colour_of((static_cast<double>(p.z) - low_z) / (high_z - low_z));
    for (int dx = 0; dx < 2; ++dx)
      for (int dy = 0; dy < 2; ++dy) set(column_of(x) + dx, row_of(y) + dy, colour);
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw PointFileError(fmt::format("{}: {}", path, static_cast<const char*>(image.message)));
  bytes.resize(size);
  write_file_bytes(path, bytes);  // libpng itself would remove what stood there when it fails
  return step;
}

}  // namespace berm::app

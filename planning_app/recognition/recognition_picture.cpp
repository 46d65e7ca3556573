#include "recognition/recognition_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "points/file_bytes.hpp"

namespace berm::app {
namespace {

constexpr double kReach = 16.0;  // m round the viewpoint
constexpr double kScale = 30.0;  // pixels a metre

// As text of an SVG: a class's name is a file's.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

}  // namespace

void write_recognition_picture(const std::string& path, const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint,
                               const RecognisedTruck& truck) {
  const double side = 2 * kReach * kScale;
  const auto across = [&](double x) { return (x - viewpoint[0] + kReach) * kScale; };
  const auto down = [&](double y) { return (viewpoint[1] - y + kReach) * kScale; };
  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{0:.0f}\" viewBox=\"0 0 {0:.0f} {0:.0f}\">\n"
                                "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                                side);
  const auto out = std::back_inserter(svg);
  for (const ScanPoint& p : points) {
    const double x = across(static_cast<double>(p.x)), y = down(static_cast<double>(p.y));
    if (!(x >= 0.0 && x <= side && y >= 0.0 && y <= side)) continue;
    const double height = std::clamp((static_cast<double>(p.z) + 3.0) / 6.5, 0.0, 1.0);
    fmt::format_to(out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"2\" height=\"2\" fill=\"hsl({:.0f},80%,45%)\"/>\n", x - 1, y - 1,
                   240 * (1 - height));
  }
  fmt::format_to(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>\n", across(viewpoint[0]), down(viewpoint[1]));
  for (std::size_t i = 0; truck.found && i < 4; ++i) {
    const Eigen::Vector3d &a = truck.corners[i], &b = truck.corners[(i + 1) % 4];
    fmt::format_to(out, "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"2\"/>\n", across(a.x()),
                   down(a.y()), across(b.x()), down(b.y()), i == 3 ? "red" : "black");
    const auto corner = static_cast<Eigen::Index>(3 * i);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(truck.covariance.block<2, 2>(corner, corner));
    const Eigen::Vector2d size = 2 * kScale * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt(), longest = axes.eigenvectors().col(1);
    fmt::format_to(out, "<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.2f}\" ry=\"{3:.2f}\" transform=\"rotate({4:.1f} {0:.1f} {1:.1f})\" "
                        "fill=\"none\" stroke=\"black\"/>\n",
                   across(a.x()), down(a.y()), size.y(), size.x(), -std::atan2(longest.y(), longest.x()) * 180.0 / 3.14159265358979323846);
  }
  const std::string line = truck.found ? fmt::format("{}: {:.2f} x {:.2f} m, walls {:.2f} m, {:.1f} ms", truck.truck_class, truck.length, truck.width,
                                                     truck.height, truck.milliseconds)
                                       : "no truck: " + truck.reason;
  fmt::format_to(out, "<text x=\"20\" y=\"30\" style=\"font:16px sans-serif\">{}</text>\n</svg>\n", escaped(line));
  write_file_bytes(path, svg);
}

}  // namespace berm::app

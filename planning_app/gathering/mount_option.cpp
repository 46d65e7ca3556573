#include "gathering/mount_option.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "points/point_cloud.hpp"

namespace berm::app {
namespace {

constexpr double kMetres = 1e5, kDegrees = 360.0;
constexpr const char* kNames[] = {"x", "y", "z", "yaw", "pitch", "roll"};

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw PointFileError(
      fmt::format("--mount: {}: {} (x,y,z,yaw[,pitch,roll]: metres within {:g}, degrees within {:g})", text.substr(0, 80), why, kMetres, kDegrees));
}

}  // namespace

Eigen::Isometry3d mount_of(const std::string& text) {
  std::array<double, 6> value{};
  std::size_t count = 0;
  for (std::string_view rest = text;; rest.remove_prefix(rest.find(',') + 1)) {
    const std::string_view word = rest.substr(0, rest.find(','));
    if (count == value.size()) refuse(text, "has more than six numbers");
    const std::string_view digits = word.substr(word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value[count]);
    if (error != std::errc{} || end != digits.data() + digits.size()) refuse(text, fmt::format("{} is no number", kNames[count]));
    if (!(std::abs(value[count]) <= (count < 3 ? kMetres : kDegrees))) refuse(text, fmt::format("{} is beyond its limit", kNames[count]));
    ++count;
    if (rest.find(',') == std::string_view::npos) break;
  }
  if (count != 4 && count != 6) refuse(text, fmt::format("has {} number{}, not 4 or 6", count, count == 1 ? "" : "s"));
  const auto turn = [&value](std::size_t i, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(value[i] * 3.14159265358979323846 / 180.0, axis);
  };
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = (turn(3, Eigen::Vector3d::UnitZ()) * turn(4, Eigen::Vector3d::UnitY()) * turn(5, Eigen::Vector3d::UnitX())).toRotationMatrix();
  out.translation() << value[0], value[1], value[2];
  return out;
}

}  // namespace berm::app

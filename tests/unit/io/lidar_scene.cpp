#include "lidar_scene.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFiringS = 55.296e-6, kFarM = 100.0;
constexpr double kBoomPinX = 0.2277, kBoomPinZ = 1.957, kLength[3] = {5.648, 2.889, 1.562}, kHalfWidth[3] = {0.25, 0.25, 0.55}, kHalfHeight = 0.2;

void nearer(double t, double& best) {
  if (t > 0.0 && t < best) best = t;
}

// Where the ray enters, or kFarM.
double cast_box(const Ray3& ray, const StandingBox& box) {
  double in = 0.0, out = kFarM;
  for (std::size_t a = 0; a < 3; ++a) {
    if (std::fabs(ray.along[a]) < 1e-12) {
      if (ray.from[a] < box.low[a] || ray.from[a] > box.high[a]) return kFarM;
      continue;
    }
    const double p = (box.low[a] - ray.from[a]) / ray.along[a], q = (box.high[a] - ray.from[a]) / ray.along[a];
    in = std::max(in, std::min(p, q));
    out = std::min(out, std::max(p, q));
  }
  return in < out && in > 0.0 ? in : kFarM;
}

double cast_person(const Ray3& ray, const StandingPerson& who) {
  const double dx = ray.from[0] - who.x, dy = ray.from[1] - who.y, a = ray.along[0] * ray.along[0] + ray.along[1] * ray.along[1];
  const double b = dx * ray.along[0] + dy * ray.along[1], c = dx * dx + dy * dy - who.radius * who.radius, root = b * b - a * c;
  if (root < 0.0) return kFarM;
  const double t = (-b - std::sqrt(root)) / a, z = ray.from[2] + t * ray.along[2];
  return t > 0.0 && z >= 0.0 && z <= who.height ? t : kFarM;  // the top is seen from no lidar that is lower
}

std::array<double, 3> turned(const std::array<double, 3>& v, double angle) {
  return {std::cos(angle) * v[0] - std::sin(angle) * v[1], std::sin(angle) * v[0] + std::cos(angle) * v[1], v[2]};
}

// Of a laser in firing order, degrees.
double elevation_deg(int laser) { return laser % 2 == 0 ? -15.0 + laser : laser; }

void put16(std::uint8_t* to, unsigned v) {
  to[0] = static_cast<std::uint8_t>(v & 0xFF);
  to[1] = static_cast<std::uint8_t>(v >> 8);
}

}  // namespace

LidarScene::LidarScene() {
  own.tracks = {{{-2.10, 0.80, 0.0}, {2.10, 1.40, 1.0}}, {{-2.10, -1.40, 0.0}, {2.10, -0.80, 1.0}}};
  own.upper_body = {{{-2.60, -1.30, 1.0}, {1.20, 1.30, 2.95}}};
}

double LidarScene::cast_arm(const Ray3& upper) const {
  double best = kFarM, angle = 0.0, x = kBoomPinX, z = kBoomPinZ;
  const double joint[3] = {own.boom_rad, own.stick_rad, own.bucket_rad};
  for (int i = 0; i < 3; ++i) {
    angle += joint[i];
    const double c = std::cos(angle), s = std::sin(angle), fx = upper.from[0] - x, fz = upper.from[2] - z;
    const double ax = upper.along[0], az = upper.along[2];
    const Ray3 local{{c * fx + s * fz, upper.from[1], c * fz - s * fx}, {c * ax + s * az, upper.along[1], c * az - s * ax}};
    nearer(cast_box(local, {{0.0, -kHalfWidth[i], -kHalfHeight}, {kLength[i], kHalfWidth[i], kHalfHeight}}), best);
    x += kLength[i] * c;
    z += kLength[i] * s;
  }
  return best;
}

double LidarScene::cast(const Ray3& base, double swing, double t, bool& of_person) const {
  double best = kFarM;
  if (base.along[2] < 0.0) nearer(-base.from[2] / base.along[2], best);
  for (const StandingBox& box : boxes) nearer(cast_box(base, box), best);
  for (const StandingBox& box : own.tracks) nearer(cast_box(base, box), best);
  const Ray3 upper{turned(base.from, -swing), turned(base.along, -swing)};
  for (const StandingBox& box : own.upper_body) nearer(cast_box(upper, box), best);
  nearer(cast_arm(upper), best);
  const double before = best;
  for (const StandingPerson& who : people)
    if (t >= who.from_s) nearer(cast_person(base, who), best);
  of_person = best < before;
  return best < kFarM ? best : 0.0;
}

double LidarSource::drawn() {
  state_ = state_ * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(state_ >> 11) * 0x1.0p-53;
}

void LidarSource::fire(std::int64_t firing, const LidarScene& scene, double swing, std::size_t record) {
  const double t = static_cast<double>(firing + 1) * kFiringS, turns = static_cast<double>(firing) * kFiringS * 10.0;
  const std::array<double, 3> head = turned({mount_.x_mm * 1e-3, mount_.y_mm * 1e-3, mount_.z_mm * 1e-3}, swing);
  for (int laser = 0; laser < 16; ++laser) {
    const double bearing = swing + mount_.yaw_urad * 1e-6 - 2 * kPi * (turns + laser * 2.304e-6 * 10.0), e = elevation_deg(laser) * kPi / 180;
    bool of_person = false;
    const double range = scene.cast({head, {std::cos(e) * std::cos(bearing), std::cos(e) * std::sin(bearing), std::sin(e)}}, swing, t, of_person);
    if (of_person && first_person_s < 0.0) first_person_s = t;
    std::uint8_t* to = packet_.data() + record + 3 * static_cast<std::size_t>(laser);
    put16(to, static_cast<unsigned>(std::lround(range * 500)));
    if (!dual_) continue;
    const bool dusty = drawn() < dust_;
    put16(to + 100, static_cast<unsigned>(std::lround((dusty ? 0.5 + drawn() * std::max(0.0, range - 0.5) : range) * 500)));
  }
}

void LidarSource::until(double t, const LidarScene& scene, const std::function<double(double)>& swing, std::vector<Packet>& out) {
  const int firings = dual_ ? 12 : 24;
  for (; static_cast<double>(next_ + 1) * kFiringS <= t; ++next_) {
    const auto place = static_cast<std::size_t>(next_ % firings);
    const std::size_t block = (dual_ ? 200 : 100) * (place / 2);
    const double turns = static_cast<double>(next_) * kFiringS * 10.0;
    for (std::size_t b = block; b <= block + (dual_ ? 100 : 0) && place % 2 == 0; b += 100) {
      put16(packet_.data() + b, 0xEEFF);
      put16(packet_.data() + b + 2, static_cast<unsigned>((turns - std::floor(turns)) * 36000) % 36000);
    }
    fire(next_, scene, swing(static_cast<double>(next_ + 1) * kFiringS), block + 4 + 48 * (place % 2));
    if (place + 1 < static_cast<std::size_t>(firings)) continue;
    const auto clock_us = static_cast<std::uint32_t>(static_cast<double>(next_ + 1) * kFiringS * 1e6);
    for (std::size_t i = 0; i < 4; ++i) packet_[1200 + i] = static_cast<std::uint8_t>(clock_us >> (8 * i));
    packet_[1204] = dual_ ? 0x39 : 0x37;
    packet_[1205] = 0x22;
    out.push_back(packet_);
  }
}

}  // namespace berm::kernel::test

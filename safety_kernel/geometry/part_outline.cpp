#include "geometry/part_outline.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/lanes.hpp"
#include "geometry/turns.hpp"

// Everything is done in the frame of the link's mean elevation and the part's tilt, where the twelve directions and the part's vertices are constants. A direction's
// support of an arc of radius R about the mean direction m, half as wide as d, is R where the direction is within d of m, else
// R cos(angle - d) = (m . u) cos d + |m x u| sin d. The derivation of the outline is in swept_slices.cpp.
namespace berm::kernel {
namespace {

constexpr double pi = 3.141592653589793;
constexpr double rad_per_urad = 1e-6;
constexpr int32_t angle_max_urad = 20000000; // keeps sums of three in int32
constexpr float outline_slack_mm = 3.0F; // 0.87 for rounding to the grid, 0.02 for float; the rest for lengths that the parameter block rounds to the millimetre
constexpr float side_slack_mm = 2.0F;
constexpr int fours = sweep_directions / 4;

// cos and sin of 30 degrees times 0..11, and the first again
constexpr float half_root_3 = 0.866025404F;
alignas(16) constexpr float twelve_r[16] = {1, half_root_3, 0.5F, 0, -0.5F, -half_root_3, -1, -half_root_3, -0.5F, 0, 0.5F, half_root_3, 1, half_root_3, 0.5F, 0};
alignas(16) constexpr float twelve_z[16] = {0, 0.5F, half_root_3, 1, half_root_3, 0.5F, 0, -0.5F, -half_root_3, -1, -half_root_3, -0.5F, 0, 0.5F, half_root_3, 1};

// The support of an arc in four directions, of which the middle lies so far along and across.
struct ArcHalf {
  float cosine, sine;
  float within; // least part of the radius along a direction that counts as inside the arc

  ArcHalf(float c, float s) noexcept : cosine(c), sine(s), within(c <= -1.0F ? -2.0F : c) {} // half a turn to either side is all directions

  Four support(Four along, Four across, Four radius) const noexcept {
    const Four beside = along * four(cosine) + across * four(sine);
    return along >= radius * four(within) ? radius : beside;
  }
};

// A vertex in the frame tilted by the angle.
void tilted(const int32_t (&corner)[2], double tilt, double& x, double& z) noexcept {
  const double c = std::cos(tilt), s = std::sin(tilt);
  x = c * corner[0] + s * corner[1];
  z = c * corner[1] - s * corner[0];
}

// Twice the area between the part's support lines in the twelve directions from the tilt on.
double outline_area(const berm_part& part, double tilt) noexcept {
  double h[sweep_directions];
  for (int i = 0; i < sweep_directions; ++i) {
    h[i] = -1e30;
    for (int v = 0; v < part.vertices; ++v) {
      double x, z;
      tilted(part.vertex_mm[v], tilt, x, z);
      h[i] = std::max(h[i], x * static_cast<double>(twelve_r[i]) + z * static_cast<double>(twelve_z[i]));
    }
  }
  double area = 0.0;
  for (int i = 0; i < sweep_directions; ++i) // the edge's length by sin 30
    area += h[i] * (h[(i + 1) % sweep_directions] + h[(i + sweep_directions - 1) % sweep_directions] - 2.0 * static_cast<double>(half_root_3) * h[i]);
  return area;
}

// Of 0 to 29 degrees: the directions come again after 30.
double best_tilt(const berm_part& part) noexcept {
  double best = 0.0, least = outline_area(part, 0.0);
  for (int degree = 1; degree < 30; ++degree) {
    const double tilt = degree * pi / 180.0, area = outline_area(part, tilt);
    if (area >= least) continue;
    least = area;
    best = tilt;
  }
  return best;
}

} // namespace

ImplementShape::ImplementShape(const berm_parameters& parameters) noexcept
    : parts(parameters.parts >= 1 && parameters.parts <= BERM_PARTS ? parameters.parts : 0), pin_x_mm(static_cast<float>(parameters.boom_pin_x_mm)),
      pin_z_mm(static_cast<float>(parameters.boom_pin_z_mm)),
      length_mm{static_cast<float>(parameters.boom_length_mm), static_cast<float>(parameters.stick_length_mm)}, part{}, tail(parameters) {
  for (int p = 0; p < parts; ++p) {
    const berm_part& from = parameters.part[p];
    Part& to = part[p];
    to.link = 0;
    if (from.link < 1 || from.link > 3 || from.vertices < 1 || from.vertices > BERM_PART_VERTICES || from.half_width_mm < 0) continue;
    to.link = from.link;
    to.half_width_mm = static_cast<float>(from.half_width_mm);
    to.reach_mm = 0.0F;
    const double tilt = best_tilt(from);
    to.tilt_cosine = static_cast<float>(std::cos(tilt));
    to.tilt_sine = static_cast<float>(std::sin(tilt));
    for (int v = 0; v < BERM_PART_VERTICES; ++v) {
      double tilted_x, tilted_z;
      tilted(from.vertex_mm[std::min(v, from.vertices - 1)], tilt, tilted_x, tilted_z);
      const float x = static_cast<float>(tilted_x), z = static_cast<float>(tilted_z);
      Vertex& vertex = to.vertex[v];
      const float radius = std::sqrt(x * x + z * z);
      for (float& r : vertex.radius) r = radius;
      for (int i = 0; i < sweep_directions; ++i) {
        vertex.along[i] = x * twelve_r[i] + z * twelve_z[i];
        vertex.across[i] = std::fabs(x * twelve_z[i] - z * twelve_r[i]);
      }
      to.reach_mm = std::max(to.reach_mm, radius);
    }
    for (int k = 0; k < from.link - 1; ++k) to.reach_mm += std::fabs(length_mm[k]);
    to.reach_mm += std::fabs(pin_x_mm);
  }
}

bool BoxSweep::set(const sk_reach_box& box, double half_swing_rad) noexcept {
  double angle[8] = {};
  int32_t low_urad = 0, high_urad = 0;
  for (int joint = 1; joint <= 3; ++joint) {
    if (box.low_urad[joint] > box.high_urad[joint] || box.low_urad[joint] < -angle_max_urad || box.high_urad[joint] > angle_max_urad) return false;
    low_urad += box.low_urad[joint];
    high_urad += box.high_urad[joint];
    angle[joint - 1] = (0.5 * rad_per_urad) * (low_urad + high_urad);
    angle[joint + 2] = (0.5 * rad_per_urad) * (high_urad - low_urad);
  }
  angle[6] = half_swing_rad;
  turns(angle, 7, cosine_, sine_);
  over_cos_half_ = 1.0F / cosine_[6];
  tan_half_ = sine_[6] * over_cos_half_;
  sagitta_ = sine_[6] * sine_[6] / (1.0F + cosine_[6]); // 1 - cos, without cancellation
  for (int link = 0; link < 3; ++link)
    if (angle[link + 3] >= pi) {
      cosine_[link + 3] = -1.0F;
      sine_[link + 3] = 0.0F;
    }
  return true;
}

BERM_LANES_CLONES bool BoxSweep::outline(const ImplementShape& shape, int part, PartOutline& out) const noexcept {
  const ImplementShape::Part& body = shape.part[part];
  if (body.link == 0) return false;
  const int link = body.link - 1;
  const float c = cosine_[link] * body.tilt_cosine - sine_[link] * body.tilt_sine, s = sine_[link] * body.tilt_cosine + cosine_[link] * body.tilt_sine;

  Four h[fours];
  const ArcHalf own(cosine_[link + 3], sine_[link + 3]);
  for (int i = 0; i < fours; ++i) {
    Four farthest = four(-1e30F);
    for (int v = 0; v < BERM_PART_VERTICES; ++v) {
      const ImplementShape::Vertex& vertex = body.vertex[v];
      farthest = most4(farthest, own.support(load4(vertex.along + 4 * i), load4(vertex.across + 4 * i), load4(vertex.radius)));
    }
    h[i] = farthest;
  }
  const float pin_along = shape.pin_x_mm * c + shape.pin_z_mm * s, pin_up = shape.pin_z_mm * c - shape.pin_x_mm * s;
  for (int i = 0; i < fours; ++i) h[i] += four(pin_along) * load4(twelve_r + 4 * i) + four(pin_up) * load4(twelve_z + 4 * i);
  for (int k = 0; k < link; ++k) {
    const float length = shape.length_mm[k];
    const float x = length * (cosine_[k] * c + sine_[k] * s), z = length * (sine_[k] * c - cosine_[k] * s); // the link's elevation less this frame's
    const ArcHalf half(cosine_[k + 3], sine_[k + 3]);
    for (int i = 0; i < fours; ++i) {
      const Four r = load4(twelve_r + 4 * i), up = load4(twelve_z + 4 * i);
      h[i] += half.support(four(x) * r + four(z) * up, magnitude4(four(x) * up - four(z) * r), four(std::fabs(length)));
    }
  }

  const float w = body.half_width_mm, cos_half_swing = cosine_[6], sin_half_swing = sine_[6];
  const float grow = body.reach_mm * sagitta_ + w * sin_half_swing; // with the reach for h_S(0) and h_S(pi): at 4.5 degrees 3 mm a metre more
  Four raised[fours];
  for (int i = 0; i < fours; ++i) {
    const Four e_r = load4(twelve_r + 4 * i), e_z = load4(twelve_z + 4 * i);
    const Four r = four(c) * e_r - four(s) * e_z, z = four(s) * e_r + four(c) * e_z;
    raised[i] = h[i] + four(grow) * magnitude4(r) + four(outline_slack_mm);
    store4(out.normal_r + 4 * i, r);
    store4(out.normal_z + 4 * i, z);
    store4(out.offset_mm + 4 * i, raised[i]);
  }

  // Corner i is where edges i and i + 1 meet: the sine of 30 degrees between them is 1/2.
  Four x[fours], z[fours], x_low = four(1e30F), x_high = four(-1e30F), z_low = four(1e30F), z_high = four(-1e30F);
  for (int i = 0; i < fours; ++i) {
    const Four here = raised[i], next = next4(here, raised[(i + 1) % fours]);
    const Four across = four(2.0F) * (here * load4(twelve_z + 4 * i + 1) - next * load4(twelve_z + 4 * i));
    const Four up = four(2.0F) * (next * load4(twelve_r + 4 * i) - here * load4(twelve_r + 4 * i + 1));
    x[i] = four(c) * across - four(s) * up;
    z[i] = four(s) * across + four(c) * up;
    x_low = least4(x_low, x[i]);
    x_high = most4(x_high, x[i]);
    z_low = least4(z_low, z[i]);
    z_high = most4(z_high, z[i]);
    store4(out.x_mm + 4 * i, x[i]);
    store4(out.z_mm + 4 * i, rounded4(z[i]));
  }
  const Four limit = four(static_cast<float>(SK_COORD_MAX_MM));
  if (!all4((z_low >= -limit) & (z_high <= limit) & (x_low >= -limit) & (x_high <= limit))) return false;
  out.x_low_mm = std::min(std::min(x_low[0], x_low[1]), std::min(x_low[2], x_low[3]));
  out.x_high_mm = std::max(std::max(x_high[0], x_high[1]), std::max(x_high[2], x_high[3]));
  const FourInt z_rounded = rounded4(z_low); // rounding keeps the order
  out.z_low_mm = std::min(std::min(z_rounded[0], z_rounded[1]), std::min(z_rounded[2], z_rounded[3]));
  const float back = std::max(0.0F, -out.x_low_mm);
  const float side = 2.0F * back * tan_half_ + w * over_cos_half_ + side_slack_mm;
  for (int i = 0; i < fours; ++i) store4(out.side_mm + 4 * i, x[i] * four(tan_half_) + four(side));
  out.side_offset_mm = side * cos_half_swing;
  const float forward = std::max(out.x_high_mm, -out.x_low_mm), widest = std::max(out.x_high_mm, 0.0F) * tan_half_ + side;
  out.reach_squared = forward * forward + widest * widest;
  out.link = body.link;
  return true;
}

} // namespace berm::kernel

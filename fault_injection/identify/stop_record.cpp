#include "identify/stop_record.hpp"

#include <algorithm>
#include <cmath>

namespace berm::identify {

namespace {

constexpr std::size_t kHeldReadings = 10;
constexpr double kFitHigh = 0.85, kFitLow = 0.15;  // share of the held speed between which the line is laid
constexpr std::size_t kLeastFit = 6;

// Where the line through the falling speeds meets the held speed.
std::optional<double> begin_of_fall(const std::vector<Sample>& s, std::size_t sent, double held) {
  double n = 0, t = 0, v = 0, tt = 0, tv = 0;
  bool falling = false;
  for (std::size_t i = sent + 1; i < s.size() && s[i].speed >= kFitLow * held; ++i) {
    falling = falling || s[i].speed <= kFitHigh * held;
    if (!falling) continue;
    const double x = s[i].time_s - s[sent].time_s;
    n += 1, t += x, v += s[i].speed, tt += x * x, tv += x * s[i].speed;
  }
  const double spread = n * tt - t * t;
  if (n < static_cast<double>(kLeastFit) || spread <= 0.0) return std::nullopt;
  const double slope = (n * tv - t * v) / spread;
  if (slope >= 0.0) return std::nullopt;
  const double begin = (held - (v - slope * t) / n) / slope;
  return s[sent].time_s + std::max(0.0, begin);  // not before it was sent
}

}  // namespace

StopRecord evaluate_stop(const StopPlan& plan, const std::vector<Sample>& s, std::size_t sent, double speed_error) {
  StopRecord record;
  record.plan = plan;
  record.sent_s = s[sent].time_s;
  for (std::size_t i = 0; i <= sent; ++i) record.approach.push_back(static_cast<float>(s[i].speed));
  const std::size_t held_from = sent + 1 >= kHeldReadings ? sent + 1 - kHeldReadings : 0;
  for (std::size_t i = held_from; i <= sent; ++i) record.held_speed += s[i].speed / static_cast<double>(sent + 1 - held_from);
  record.obeyed_s = begin_of_fall(s, sent, record.held_speed);
  std::size_t slow = s.size() - 1;  // the first reading from which on all are within the error of zero
  while (slow > sent && std::abs(s[slow].speed) <= speed_error) --slow;
  slow = std::min(slow + 1, s.size() - 1);
  // there it may still move at twice the error, and lose that at no less than its mean deceleration
  const double falling = std::max(s[slow].time_s - record.sent_s, 1e-3);
  record.rest_s = s[slow].time_s + 2.0 * speed_error * falling / std::max(record.held_speed, speed_error);
  record.farthest_angle = s[sent].angle;
  for (std::size_t i = sent; i < s.size(); ++i) record.farthest_angle = std::max(record.farthest_angle, s[i].angle);
  for (std::size_t i = sent > 0 ? sent - 1 : 0; i < s.size(); ++i) {
    record.first.push_back(s[i]);
    if (i > sent + 1 && s[i].speed < 0.5 * record.held_speed) break;
  }
  return record;
}

double angle_at(const StopRecord& record, double time_s) {
  const auto& s = record.first;
  if (time_s <= s.front().time_s) return s.front().angle;
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (time_s > s[i].time_s) continue;
    const double f = (time_s - s[i - 1].time_s) / (s[i].time_s - s[i - 1].time_s);
    return s[i - 1].angle + f * (s[i].angle - s[i - 1].angle);
  }
  return s.back().angle;
}

}  // namespace berm::identify

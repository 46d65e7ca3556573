#include "truck_world/arrival.hpp"

#include <time.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "recognition/ongoing_recognition.hpp"
#include "run/percentile_json.hpp"

namespace berm::truck_world {
namespace {

using Json = nlohmann::ordered_json;

constexpr double scanline_ms = 1e3 * samples_per_scanline / sample_rate_hz;
constexpr double asked_for_ms = 50.0;  // after the last scanline that shows the truck

double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

template <typename Work>
double milliseconds_of(const Work& work) {
  const double begin = thread_ms();
  work();
  return thread_ms() - begin;
}

double arrives_ms(std::uint32_t scanline) { return scanline_ms * (scanline + 1.0); }

double last_of_truck_ms(const Scene& scene) {
  double last = 0.0;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i)
    if (!scene.point_truth[i].outlier && is_truck(scene.point_truth[i].surface)) last = std::max(last, arrives_ms(scene.cloud[i].scanline));
  return last;
}

Json share(const std::vector<double>& values, double most) {
  if (values.empty()) return nullptr;
  return static_cast<double>(std::count_if(values.begin(), values.end(), [most](double v) { return v <= most; })) / static_cast<double>(values.size());
}

}  // namespace

Arrival take_as_it_arrives(const Scene& scene, const app::TruckRangeSet& ranges) {
  Arrival out;
  app::OngoingRecognition recognition(viewpoint_of(scene), ranges);
  double free = 0.0;  // when the thread has done what came so far
  const auto ask = [&] {
    const double took = milliseconds_of([&] { recognition.ask(); });
    ++out.asks;
    out.asking += took;
    free += took;
  };
  app::visit_scanlines(scene.cloud, [&](std::span<const app::ScanPoint> scanline) {
    if (out.early) return;
    bool asks = false;
    out.scanlines.push_back(milliseconds_of([&] { asks = recognition.take(scanline); }));
    free = std::max(free, arrives_ms(scanline.front().scanline)) + out.scanlines.back();
    if (!asks) return;
    ask();
    out.early = recognition.stands();
  });
  if (!out.early) {
    free = std::max(free, 1e3 * scene.sweep.duration());
    ask();
  }
  out.trial = judge(scene, recognition.ask());
  out.after_last_scanline = free - last_of_truck_ms(scene);
  return out;
}

Json summary(const std::vector<Arrival>& arrivals) {
  int trucks = 0, recognised = 0, non_trucks = 0, accepted = 0, early = 0;
  std::vector<double> corners, after, scanlines, asks, asking;
  for (const Arrival& a : arrivals) {
    scanlines.insert(scanlines.end(), a.scanlines.begin(), a.scanlines.end());
    asks.push_back(a.asks);
    asking.push_back(a.asking);
    if (!a.trial.truck) {
      ++non_trucks;
      accepted += a.trial.found ? 1 : 0;
      continue;
    }
    ++trucks;
    if (!a.trial.recognised) continue;
    ++recognised;
    early += a.early ? 1 : 0;
    after.push_back(a.after_last_scanline);
    corners.insert(corners.end(), a.trial.corner_errors.begin(), a.trial.corner_errors.end());
  }
  Json json;
  json["trucks"] = trucks;
  json["recognised"] = recognised;
  json["before_sweeps_end"] = early;
  json["corner_error_m_p50"] = run::percentile_or_null(corners, 0.5);
  json["corner_error_m_p95"] = run::percentile_or_null(corners, 0.95);
  json["non_trucks"] = non_trucks;
  json["false_accepts"] = accepted;
  json["scanlines_per_s"] = 1e3 / scanline_ms;
  json["answer_after_last_scanline_ms_p50"] = run::percentile_or_null(after, 0.5);
  json["answer_after_last_scanline_ms_p95"] = run::percentile_or_null(after, 0.95);
  json["answer_after_last_scanline_ms_max"] = run::percentile_or_null(after, 1.0);
  json["answer_within_50_ms"] = share(after, asked_for_ms);
  json["scanline_ms_p50"] = run::percentile_or_null(scanlines, 0.5);
  json["scanline_ms_p95"] = run::percentile_or_null(scanlines, 0.95);
  json["scanline_ms_max"] = run::percentile_or_null(scanlines, 1.0);
  json["asks_p50"] = run::percentile_or_null(asks, 0.5);
  json["asks_max"] = run::percentile_or_null(asks, 1.0);
  json["asking_ms_p50"] = run::percentile_or_null(asking, 0.5);
  json["asking_ms_max"] = run::percentile_or_null(asking, 1.0);
  return json;
}

}  // namespace berm::truck_world

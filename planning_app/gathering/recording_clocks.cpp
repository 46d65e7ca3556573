#include "gathering/recording_clocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace berm::app {

RecordingTimes times_of(const PointCloud& recording) {
  RecordingTimes out{recording.file, recording.format, recording.times && !recording.points.empty()};
  if (!out.times) return out;
  const auto [first, last] = std::minmax_element(recording.points.begin(), recording.points.end(),
                                                 [](const ScanPoint& p, const ScanPoint& q) { return p.time_s < q.time_s; });
  out.first_s = first->time_s;
  out.last_s = last->time_s;
  return out;
}

std::vector<std::vector<std::size_t>> played_together(std::span<const RecordingTimes> recordings, ClockRule rule) {
  const auto together = [&](const RecordingTimes& a, const RecordingTimes& b) {
    if (rule != ClockRule::kByTimes) return rule == ClockRule::kOne;
    const auto of_a_common_clock = [](const RecordingTimes& r) { return r.times && r.format == "pcd" && r.first_s != 0.0; };
    return of_a_common_clock(a) && of_a_common_clock(b) && a.first_s <= b.last_s && b.first_s <= a.last_s;
  };
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (rule == ClockRule::kOne && !recordings[i].times)
      throw PointFileError(fmt::format("{}: time: the file has none, and --clock one wants one of every file", recordings[i].file));
    const auto met = [&](const std::vector<std::size_t>& group) {
      return std::any_of(group.begin(), group.end(), [&](std::size_t k) { return together(recordings[i], recordings[k]); });
    };
    std::vector<std::size_t> joined{i};  // one recording may tie several groups together
    auto place = groups.end();
    for (auto group = groups.begin(); group != groups.end();) {
      if (!met(*group)) {
        ++group;
        continue;
      }
      joined.insert(joined.end(), group->begin(), group->end());
      if (place == groups.end()) {
        place = group++;
      } else {
        group = groups.erase(group);
      }
    }
    std::sort(joined.begin(), joined.end());
    if (place == groups.end())
      groups.push_back(std::move(joined));
    else
      *place = std::move(joined);
  }
  return groups;
}

}  // namespace berm::app

// berm gather: point-cloud gathering over recorded scans.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "config/command_line.hpp"
#include "config/one_line.hpp"
#include "config/standard_error.hpp"
#include "gathering/gather_journal.hpp"
#include "gathering/gather_picture.hpp"
#include "gathering/gather_recording.hpp"
#include "gathering/mount_option.hpp"
#include "gathering/recording_clocks.hpp"
#include "points/file_bytes.hpp"
#include "points/pcd.hpp"
#include "points/recording.hpp"

namespace berm::app {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> mounts;
  std::string json, pcd, picture, clock = "auto";
  GatheringOptions gathering;
  ScannerDeviations deviations;
};

// The files, read twice when their times decide what is played together: of the first look only what cannot be read again is kept.
class Inputs {
public:
  Inputs(const std::vector<std::string>& files, bool show) : files_(files), again_(files.size()), show_(show) {}

  std::vector<std::vector<std::size_t>> groups(ClockRule rule) {
    std::vector<RecordingTimes> times;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (files_.size() == 1 || rule == ClockRule::kOwn) {  // nothing to decide
        times.push_back({files_[i], "", false});
        continue;
      }
      PointCloud recording = read(i);
      times.push_back(times_of(recording));
      std::error_code none;
      if (!std::filesystem::is_regular_file(files_[i], none)) again_[i] = std::move(recording);
    }
    return played_together(times, files_.size() == 1 ? ClockRule::kOwn : rule);
  }
  PointCloud take(std::size_t i) {
    if (!again_[i]) return read(i);
    PointCloud kept = std::move(*again_[i]);
    again_[i].reset();
    return kept;
  }

private:
  PointCloud read(std::size_t i) const {
    if (show_) config::print_error("reading {}\n", files_[i]);
    return read_recording(files_[i]);
  }
  const std::vector<std::string>& files_;
  std::vector<std::optional<PointCloud>> again_;
  bool show_;
};

// What is written at the end, for which memory may be too small.
template <typename Write>
auto written(const std::string& file, std::size_t points, Write write) try {
  return write();
} catch (const std::bad_alloc&) {
  throw PointFileError(fmt::format("{}: memory: too little to write {} points", file, points));
}

struct Played {
  double seconds = 0.0;
  std::size_t unplanned = 0, cleared = 0;
  nlohmann::json groups = nlohmann::json::array();  // what together, in which order
  std::string order;
};

// Twice a second at most.
class Progress {
public:
  explicit Progress(bool show) : show_(show) {}
  bool due() {
    if (!show_ || std::chrono::steady_clock::now() - shown_ < std::chrono::milliseconds(500)) return false;
    shown_ = std::chrono::steady_clock::now();
    return true;
  }

private:
  bool show_;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

double seconds_since(std::chrono::steady_clock::time_point begin) { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); }

Played play_recordings(const Options& options, const std::vector<Eigen::Isometry3d>& mounts, bool show, PointCloudGatherer& gatherer) {
  Played played;
  for (std::size_t i = 0; i < options.files.size(); ++i) gatherer.add_scanner(options.deviations);
  Inputs inputs(options.files, show);
  Progress progress(show);
  const ClockRule rule = options.clock == "one" ? ClockRule::kOne : options.clock == "own" ? ClockRule::kOwn : ClockRule::kByTimes;
  for (const std::vector<std::size_t>& group : inputs.groups(rule)) {
    std::vector<PointCloud> recordings;
    std::vector<RecordingPlayer> players;
    auto names = nlohmann::json::array();
    recordings.reserve(group.size());
    for (const std::size_t i : group) {
      recordings.push_back(inputs.take(i));
      players.emplace_back(recordings.back(), i, mounts[mounts.size() == 1 ? 0 : i]);
      played.order += fmt::format("{}{}", i == group.front() ? (played.order.empty() ? "" : ", then ") : " with ", options.files[i]);
      names.push_back(options.files[i]);
    }
    played.groups.push_back(std::move(names));
    const auto begin = std::chrono::steady_clock::now();
    play_together(players, gatherer, [&](const RecordingPlayer& player) {
      if (progress.due()) config::print_error("\r{}: {} of {} points", player.recording().file, player.played(), player.recording().points.size());
    });
    played.seconds += seconds_since(begin);
    for (const RecordingPlayer& player : players) {
      played.unplanned += player.unplanned();
      if (show) config::print_error("\r{}: {} points gathered   \n", player.recording().file, player.played());
    }
  }
  return played;
}

Played play_journal(const Options& options, const Eigen::Isometry3d& mount, bool show, PointCloudGatherer& gatherer) {
  Played played;
  const std::string& file = options.files.front();
  played.groups.push_back(nlohmann::json::array({file}));
  JournalScans journal(file);
  Progress progress(show);
  const auto begin = std::chrono::steady_clock::now();
  played.cleared = gather_journal(journal, options.deviations, mount, gatherer, [&] {
    if (progress.due()) config::print_error("\r{}: {} cycles, {} scans", file, journal.cycles(), gatherer.counts().scans);
  });
  played.seconds = seconds_since(begin);
  if (show) config::print_error("\r{}: {} cycles, {} scans gathered   \n", file, journal.cycles(), gatherer.counts().scans);
  if (journal.cut_off()) fmt::print("{} breaks off after {} cycles: what came before is gathered\n", config::one_line(file), journal.cycles());
  return played;
}

int run(const Options& options) {
  if (options.mounts.size() > 1 && options.mounts.size() != options.files.size())
    throw PointFileError(fmt::format("--mount: given {} times for {} files: once for all, or each", options.mounts.size(), options.files.size()));
  std::vector<Eigen::Isometry3d> mounts;
  for (const std::string& text : options.mounts) mounts.push_back(mount_of(text));
  if (mounts.empty()) mounts.push_back(Eigen::Isometry3d::Identity());
  const auto journal = std::find_if(options.files.begin(), options.files.end(), JournalScans::is_journal);
  if (journal != options.files.end() && options.files.size() > 1)
    throw PointFileError(fmt::format("{}: a journal has both scanners and a clock of its own: it is gathered by itself, not with {} other files", *journal, options.files.size() - 1));
  GatheringOptions gathering = options.gathering;
  if (journal == options.files.end()) gathering.epoch = kEpochRuleOfRecordings;
  PointCloudGatherer gatherer(gathering);
  const bool show = isatty(2) != 0;
  const Played played = journal != options.files.end() ? play_journal(options, mounts.front(), show, gatherer) : play_recordings(options, mounts, show, gatherer);
  const GatheringCounts counts = gatherer.counts();
  const double rate = static_cast<double>(counts.points_in) / std::max(played.seconds, 1e-9);
  const std::size_t kept = gatherer.store().size();
  const std::string& last = options.picture.empty() ? options.pcd : options.picture;
  const auto points = written(last.empty() ? options.files.back() : last, kept, [&] { return gatherer.points(); });
  if (!options.json.empty()) {
    const nlohmann::json result{
        {"files", options.files},           {"played", played.groups},           {"scans", counts.scans},           {"points_in", counts.points_in},
        {"points_kept", kept},              {"deleted", counts.deleted},  {"merged", counts.merged},         {"overflowed", counts.overflowed},
        {"ignored", counts.ignored},        {"epochs", gatherer.epoch()}, {"scans_without_plane", played.unplanned}, {"points_per_second", rate},
        {"bytes", gatherer.bytes()},        {"cleared", played.cleared}};
    write_file_bytes(options.json, result.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  if (!options.pcd.empty()) written(options.pcd, kept, [&] { return write_pcd(options.pcd, points), 0; });
  fmt::print("{} scans, {} points in: {} kept, {} merged, {} deleted, {} overflowed, {} ignored; {:.0f} points/s, {:.1f} MB\n", counts.scans,
             counts.points_in, kept, counts.merged, counts.deleted, counts.overflowed, counts.ignored, rate,
             static_cast<double>(gatherer.bytes()) * 1e-6);
  if (options.files.size() > 1) fmt::print("played {}\n", config::one_line(played.order));
  if (played.unplanned > 0) fmt::print("{} scans are no plane through the scanner: merged, and nothing deleted for them\n", played.unplanned);
  if (played.cleared > 0) fmt::print("cleared {} times, where the kernel began its map anew\n", played.cleared);
  if (!options.picture.empty())
    fmt::print("picture: {} (grid {:g} m)\n", options.picture,
               written(options.picture, kept, [&] { return write_cloud_picture(options.picture, points); }));
  return kept > 0 ? 0 : 1;
}

}  // namespace
}  // namespace berm::app

int main(int argc, char** argv) {
  berm::app::Options options;
  CLI::App app{
      "Gathers recorded scans into one point cloud: merges what is measured again, deletes what was seen through. A FILE is a PCD with "
      "scanline and time, a capture (pcap) of a VLP-16, a JSON export of an LMS1xx session, or the journal of a run (journal.mcap), by itself: "
      "both scanners, by the recorded angles of swing and pan. PCDs whose times overlap are played together, by time; other files one after another. "
      "Exit status 1: no point was kept.",
      "berm gather"};
  app.add_option("FILE", options.files, "recordings, each of a scanner of its own")->required();
  berm::config::output(app.add_option("--json", options.json,
                 "write files, played (what together, in which order), scans, points_in, points_kept, deleted, merged, overflowed, ignored, "
                 "scans_without_plane, epochs, points_per_second, bytes, cleared"));
  berm::config::output(app.add_option("--pcd", options.pcd, "write the cloud"));
  berm::config::output(app.add_option("--picture", options.picture, "write a view from above (PNG)"));
  app.add_option("--mount", options.mounts,
                 "a scanner's place in the cloud's frame: x,y,z in metres, yaw,pitch,roll in degrees (the last two may be left out): turned by roll "
                 "about x, by pitch about y, by yaw about z; 0,0,1,0,0,90 is a scan plane upright along x. Once for all files or once for each")
      ->take_all();
  app.add_option("--clock", options.clock,
                 "which files' times are of one clock: one: of all, own: of none, auto: of PCDs whose times overlap and do not begin at 0; those of one "
                 "clock are played together")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "one", "own"}));
  app.add_option("--capacity", options.gathering.capacity, "points kept at most; the lowest epochs go first")
      ->capture_default_str()
      ->check(CLI::Range(1, 200'000'000));
  app.add_option("--range-limit", options.gathering.range_limit_m, "farther returns are not used, metres")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--shrink", options.gathering.shrink_m, "of the deletion volumes, metres, beside the deviations")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--range-deviation", options.deviations.range_m, "standard deviation of a range, metres")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1.0));
  app.add_option("--along-deviation", options.deviations.along_rad, "of the angle along the scan plane, radians")
      ->capture_default_str()
      ->check(CLI::Range(1e-5, 0.1));
  app.add_option("--across-deviation", options.deviations.across_rad, "of the angle across it, radians")
      ->capture_default_str()
      ->check(CLI::Range(1e-5, 0.1));
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  try {
    return berm::app::run(options);
  } catch (const std::exception& error) {
    berm::config::print_error("berm gather: {}\n", error.what());
    return 2;
  }
}

// berm trucks: drawn scenes with and without a truck through the app's recogniser, judged by the truth.
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "config/command_line.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "in_process/workers.hpp"
#include "run/interruption.hpp"
#include "truck_world/arrival.hpp"

namespace berm::truck_world {
namespace {

struct TrialOptions {
  int scenes = 0;
  std::uint64_t seed = 1;
  int only = -1;
  int jobs = 1;
  bool trucks = false, no_trucks = false, list = false, arriving = false;
  std::string again;  // what else was given that a scene depends on, as a command has it
  std::string json, table, drawn = BERM_TRUCK_CLASSES, ranges = BERM_TRUCK_RANGES;
  SceneOptions scene;
};

std::string unseen(const Trial& t) {
  return fmt::format("{:.0f} % of the edge without a return, {:.0f} % occluded{}{}", 100 * t.hidden_share, 100 * t.occluded_share,
                     t.wall_hidden.empty() ? "" : ", all of ", t.wall_hidden);
}

void report(const Trial& t, const TrialOptions& o) {
  const bool failed = t.truck ? !t.recognised : t.found;
  if (!failed && !o.list) return;
  const std::string again = fmt::format("./berm trucks --scenes {} --seed {} --only {} {} --list{}", o.scenes, o.seed, t.scene,
                                        t.truck ? "--trucks" : "--no-trucks", o.again);
  if (!t.truck) {
    fmt::print("{} {}: {} [{}]\n", t.found ? "ACCEPTED" : "none", t.look_alike.empty() ? "clutter" : t.look_alike,
               t.found ? fmt::format("{:.2f} x {:.2f}", t.pose.length, t.pose.width) : t.reason, again);
  } else if (!t.found) {
    fmt::print("MISSED {} (tailgate {}, {}): {} [{}]\n", t.truck_class, t.tailgate, unseen(t), t.reason, again);
  } else {
    fmt::print("{} {} (tailgate {}, {}): corners off by {:.3f} {:.3f} {:.3f} {:.3f} m, yaw {:.2f} deg, length {:.3f}, width "
               "{:.3f}, height {:.3f} m, nees {:.1f}, {:.1f} ms [{}]\n",
               t.recognised ? "found" : "MISPLACED", t.truck_class, t.tailgate, unseen(t), t.corner_errors[0], t.corner_errors[1],
               t.corner_errors[2], t.corner_errors[3], t.yaw_error * 180 / pi, t.length_error, t.width_error, t.height_error, t.nees, t.milliseconds,
               again);
  }
  if (!o.list) return;
  const app::BedEvidence& e = t.evidence;
  fmt::print("  evidence {:.1f}: outer faces {}, inner faces {}, tops {}, inside {}, through {}, before {}, over {}; over the opening {} level, "
             "{} below, {} above; open end {}; {:.2f} x {:.2f}, cab {:.0f}; the truth weighs {:.1f}, its cab {:.0f}\n",
             e.score, e.outer_face, e.inner_face, e.wall_top, e.inside, e.through, e.before, e.over, e.level_inside, e.below_inside, e.above_inside,
             t.pose.open_end, t.pose.length, t.pose.width, t.cab, t.true_score, t.true_cab);
  if (t.found) fmt::print("  told as {}\n", t.told_class);
  if (t.planes.floor) fmt::print("  floor {:.2f} m below the tops, {} returns, flatness {:.1f}, spread {:.4f} of {:.4f}; truly {:.2f}, {}\n", t.planes.floor->depth, t.planes.floor->count, t.planes.floor->flatness, t.planes.floor->spread, t.planes.floor->noise, t.true_height, t.fill);
  if (t.planes.canopy) fmt::print("  canopy beyond {}, {:.2f} m, rise {:.2f}, {} returns, spread {:.4f} of {:.4f}\n", t.planes.canopy->end, t.planes.canopy->length, t.planes.canopy->rise, t.planes.canopy->count, t.planes.canopy->spread, t.planes.canopy->noise);
}

struct Judged {
  std::vector<Trial> whole;      // of whole sweeps
  std::vector<Arrival> arrived;  // of the same scenes, scanline by scanline, where that was asked for
};

void add(Judged& to, const Judged& more) {
  to.whole.insert(to.whole.end(), more.whole.begin(), more.whole.end());
  to.arrived.insert(to.arrived.end(), more.arrived.begin(), more.arrived.end());
}

// Of one number: the scene with a truck, and that without.
Judged trials_of(int number, const TrialOptions& o, const std::vector<TruckClass>& classes, const app::TruckRangeSet& ranges) {
  Judged judged;
  for (const Content content : {Content::truck, Content::no_truck}) {
    if ((content == Content::truck && o.no_trucks) || (content == Content::no_truck && o.trucks)) continue;
    SceneOptions options = o.scene;
    options.content = content;
    const Scene scene = draw_scene(classes, options, o.seed, number);
    judged.whole.push_back(judge(scene, app::recognise_truck(scene.cloud, viewpoint_of(scene), ranges)));
    if (o.arriving) judged.arrived.push_back(take_as_it_arrives(scene, ranges));
  }
  return judged;
}

void report(const Judged& judged, const TrialOptions& o) {
  for (std::size_t i = 0; i < judged.whole.size(); ++i) {
    report(judged.whole[i], o);
    if (!o.arriving) continue;
    const Arrival& a = judged.arrived[i];
    if (o.list || a.trial.recognised != judged.whole[i].recognised || a.trial.found != judged.whole[i].found)
      fmt::print("  as it arrives, scene {}: {}{}, {} asks, {:.0f} ms{}\n", a.trial.scene,
                 !a.trial.found ? "none" : a.trial.truck && !a.trial.recognised ? "MISPLACED" : a.trial.truck ? "found" : "ACCEPTED",
                 a.early ? " before the sweep's end" : "", a.asks, a.asking,
                 a.trial.truck ? fmt::format(", {:.0f} ms after the last scanline of the truck", a.after_last_scanline) : "");
  }
}

constexpr int kSamples = 72000;  // about 18,800 returns: the rest of a mirror's turn sees the sky or the machine

int run(int argc, char** argv) {
  TrialOptions o;
  o.scene.samples = kSamples;
  CLI::App app{
      "Draws N scenes with a truck and N without, gives one sweep over each to the planning app's truck recogniser, and judges the answers by the\n"
      "truth. Failures are listed with the command that repeats them. Exit status 0: every truck was recognised and nothing else was.\n"
      "SIGINT or SIGTERM ends it with the result of what was judged until then, and status 1.",
      "berm trucks"};
  app.add_option("--scenes", o.scenes, "this many with a truck, and this many without")->required()->check(CLI::Range(1, 1000000));
  app.add_option("--seed", o.seed, "seed of every draw")->capture_default_str();
  berm::config::output(app.add_option("--json", o.json, "write the result"));
  berm::config::output(app.add_option("--table", o.table, "writes a row for each scene (CSV): errors, the recogniser's own deviations, evidence, times"));
  app.add_option("--only", o.only, "this one scene alone")->check(CLI::Range(0, 999999));
  app.add_option("--jobs", o.jobs, "so many scenes at a time; their CPU times are larger on a computer that has more to do")->check(CLI::Range(1, 256))->capture_default_str();
  auto* with = app.add_flag("--trucks", o.trucks, "only the scenes with a truck");
  app.add_flag("--no-trucks", o.no_trucks, "only the scenes without")->excludes(with);
  app.add_flag("--arriving", o.arriving, "the scanlines of each scene one by one as well: which answer stands, and how long after the last that shows the truck");
  app.add_flag("--list", o.list, "one line for every scene, with its evidence");
  app.add_option("--points", o.scene.samples, "samples of a sweep; about a quarter of them come back with a return")->check(CLI::Range(9200, 1000000))->capture_default_str();
  app.add_option("--noise", o.scene.noise.stddev, "standard deviation of a range, m")->check(CLI::Range(0.0, 0.5))->capture_default_str();
  app.add_option("--hidden", o.scene.hidden_max, "most of the edge that an occluder hides")->check(CLI::Range(0.0, 0.3))->capture_default_str();
  app.add_option("--end-hidden", o.scene.end_hidden_share, "share of the trucks of which an occluder hides an end wall whole, where their place allows it")
      ->check(CLI::Range(0.0, 1.0))->capture_default_str();
  app.add_option("--swinging", o.scene.swinging_share, "share of scenes in which the machine swings")
      ->check(CLI::Range(0.0, 1.0))->capture_default_str();
  app.add_option("--classes", o.drawn, "file of truck classes that are drawn")->capture_default_str();
  app.add_option("--ranges", o.ranges, "file of truck classes that are recognised")->capture_default_str();
  if (const auto status = config::parse_options(app, argc, argv)) return *status;
  if (const std::string wrong = config::not_below("--only", o.only, "--scenes", o.scenes); !wrong.empty()) {
    config::print_error("berm trucks: {} (see --help)\n", wrong);
    return 2;
  }

  o.again = config::options_again(app, {"--scenes", "--seed", "--only", "--trucks", "--no-trucks", "--list", "--json", "--table", "--jobs"});
  const std::vector<TruckClass> classes = read_truck_classes(o.drawn);
  const app::TruckRangeSet ranges = app::read_truck_ranges(o.ranges);
  const int first = o.only >= 0 ? o.only : 0, count = o.only >= 0 ? 1 : o.scenes;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const run::Interruption interruption;  // before the threads
  std::vector<Judged> judged(static_cast<std::size_t>(count));
  std::vector<bool> ready(judged.size(), false);
  Judged all;
  std::size_t told = 0;  // in the order of the scenes, whatever is done first
  const int done = in_process::run_trials(
      count, o.jobs, [&](int k) { judged[static_cast<std::size_t>(k)] = trials_of(first + k, o, classes, ranges); },
      [&](int finished, int k) {
        ready[static_cast<std::size_t>(k)] = true;
        for (; told < judged.size() && ready[told]; ++told) {
          report(judged[told], o);
          add(all, judged[told]);
        }
        if (terminal && finished % 10 == 0) config::print_error("\r{} of {} scenes", finished, count);
      },
      [&] { return interruption.asked(); });
  if (terminal) config::print_error("\n");
  const int signal = done < count ? interruption.take() : 0;
  if (signal != 0) config::print_error("berm trucks: interrupted ({}) after {} of {} scenes\n", strsignal(signal), done, count);
  if (done == 0) return 1;
  nlohmann::ordered_json json{{"asked", count}, {"scenes", done}};
  json.update(summary(all.whole));
  if (o.arriving) json["arriving"] = summary(all.arrived);
  if (done < count) fmt::print("{} of {} scenes: interrupted\n", done, count);
  fmt::print("{}", config::json_text(json, 1));
  if (!o.table.empty()) config::write_whole_file(o.table, table(all.whole));
  if (!o.json.empty()) config::write_whole_file(o.json, config::json_text(json, 1));
  return signal == 0 && json["trucks"] == json["recognised"] && json["false_accepts"] == 0 ? 0 : 1;
}

}  // namespace
}  // namespace berm::truck_world

int main(int argc, char** argv) {
  try {
    return berm::truck_world::run(argc, argv);
  } catch (const std::exception& error) {
    berm::config::print_error("berm trucks: {}\n", error.what());
    return 2;
  }
}

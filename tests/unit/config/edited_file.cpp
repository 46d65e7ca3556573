#include "edited_file.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace berm::config::test {

namespace {

std::string lidar(const std::string& height = "3.0", const std::string& yaw = "yaw_deg = 0.0\n") {
  return "[[lidar]]\nposition = [0.0, 0.0, " + height + "]\nroll_deg = 0.0\npitch_deg = 0.0\n" + yaw;
}

std::string four_lanes() {
  std::string all;
  for (int i = 0; i < 4; ++i) all += "[[truck_lane]]\nx = [0.0, 1.0]\ny = [0.0, 1.0]\n";
  return all;
}

std::string nine_goals() {
  std::string all;
  for (int i = 0; i < 9; ++i) all += "[[dig.goal]]\nx = [5.0, 6.0]\ny = [0.0, 1.0]\nlevel = -1.0\n";
  return all;
}

}  // namespace

std::string machine_path() { return BERM_CONFIG_FILES "/machines/zx200.toml"; }
std::string site_path() { return BERM_CONFIG_FILES "/sites/bench.toml"; }

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

const std::vector<BadEdit>& bad_machine_edits() {
  static const std::vector<BadEdit> edits = {
      {"syntax", "schema = 1", "schema = = 1", "line 3", "not valid TOML"},
      {"key twice", "schema = 1", "schema = 1\nschema = 1", "line 4", "not valid TOML: schema is defined already"},
      {"other schema", "schema = 1", "schema = 2", "schema", "2 is outside 1 .. 1"},
      {"schema as text", "schema = 1", "schema = \"1\"", "schema", "whole number"},
      {"no name", "name = \"zx200\"", "", "name", "is missing"},
      {"empty name", "name = \"zx200\"", "name = \"\"", "name", "1 to 200"},
      {"name as number", "name = \"zx200\"", "name = 4", "name", "text"},
      {"unknown key", "boom = 5.648", "boom = 5.648\ncolour = 3", "kinematics.colour", "not a known key"},
      {"unknown key at the top", "name = \"zx200\"", "name = \"zx200\"\nrange_deg = 3", "range_deg", "not a known key"},
      {"unknown table", "[latency]", "[delay]\nstate = 1\n[latency]", "delay", "not a known key"},
      {"missing key", "boom = 5.648", "", "kinematics.boom", "is missing"},
      {"missing table", "[latency]", "[kernel.latency]", "latency", "is missing"},
      {"table as number", "[kinematics]", "kinematics = 3\n[other]", "kinematics", "table"},
      {"text for a number", "boom = 5.648", "boom = \"5.648\"", "kinematics.boom", "number"},
      {"truth value for a number", "boom = 5.648", "boom = true", "kinematics.boom", "number"},
      {"not a number", "boom = 5.648", "boom = nan", "kinematics.boom", "outside 1 .. 12"},
      {"infinite", "boom = 5.648", "boom = inf", "kinematics.boom", "outside 1 .. 12"},
      {"negative length", "boom = 5.648", "boom = -5.648", "kinematics.boom", "outside 1 .. 12"},
      {"too long", "boom = 5.648", "boom = 11.9", "kinematics.bucket", "together"},
      {"range the wrong way", "range_deg = [-55.0, 70.0]", "range_deg = [70.0, -55.0]", "joint.boom.range_deg", "not below"},
      {"range of three", "range_deg = [-55.0, 70.0]", "range_deg = [-55.0, 0.0, 70.0]", "joint.boom.range_deg", "2 numbers"},
      {"boom over the top", "range_deg = [-55.0, 70.0]", "range_deg = [-55.0, 190.0]", "joint.boom.range_deg", "outside -180 .. 180"},
      {"joint missing", "[joint.boom]", "[joint.arm]", "joint.boom", "is missing"},
      {"speed zero", "velocity_max_deg_s = 50.0", "velocity_max_deg_s = 0.0", "joint.swing.velocity_max_deg_s", "outside 1 .. 180"},
      {"creep too fast", "creep_deg_s = 5.0", "creep_deg_s = 16.0", "joint.stick.creep_deg_s", "outside"},
      {"creep above full speed", "velocity_max_deg_s = 50.0", "velocity_max_deg_s = 2.0", "joint.swing.creep_deg_s", "above"},
      {"bucket that holds nothing", "payload_kg = 1600.0", "payload_kg = 0.0", "bucket.payload_kg", "outside 50 .. 50000"},
      {"bucket of unknown content", "payload_kg = 1600.0", "", "bucket.payload_kg", "is missing"},
      {"negative latency", "command = 0.09", "command = -0.09", "latency.command", "outside 0.001 .. 1"},
      {"command obeyed at once", "command = 0.09", "command = 0.0", "latency.command", "0 is outside 0.001 .. 1"},
      {"states of no age", "state = 0.02", "state = 0.0", "latency.state", "0 is outside 0.001 .. 0.5"},
      {"states younger than a cycle", "state = 0.02", "state = 0.009", "kernel.cycle", "0.01 is above latency.state, 0.009"},
      {"command obeyed within a cycle", "command = 0.09", "command = 0.009", "kernel.cycle", "0.01 is above latency.command, 0.009"},
      {"angles without an error", "angle_error_deg = 0.15", "angle_error_deg = 0.0", "joint.swing.angle_error_deg", "0 is outside 0.02 .. 5"},
      {"speeds without an error", "velocity_error_deg_s = 0.3", "velocity_error_deg_s = 0", "joint.swing.velocity_error_deg_s", "0 is outside 0.01 .. 5"},
      {"no margin", "\nmargin = 0.30", "\nmargin = 0.0", "kernel.margin", "0 is outside 0.1 .. 2"},
      {"cycle that counts as late", "cycle = 0.01", "cycle = 0.021", "kernel.cycle", "0.021 is outside 0.001 .. 0.02"},
      {"digging at full swing", "dig_swing_limit_deg_s = 6.0", "dig_swing_limit_deg_s = 15.1", "kernel.dig_swing_limit_deg_s", "15.1 is outside 0.1 .. 15"},
      {"no way to brake", "[0, 1.97, 5.94,", "[0, 0, 5.94,", "braking.swing.angle_deg", "row 1, column 2: 0 is below 0.2715, a stop at 4 times acceleration_max_rad_s2"},
      {"no time to brake", "[0, 0.421, 0.776,", "[0, 0.07, 0.776,", "braking.swing.time_s", "row 1, column 2: 0.07 is below 0.07602, a stop at 4 times"},
      {"brakes like nothing else", "acceleration_max_rad_s2 = 0.41", "acceleration_max_rad_s2 = 0.07", "braking.swing.time_s", "a stop at 4 times acceleration_max_rad_s2"},
      {"no provenance", "provenance =", "source =", "braking.provenance", "is missing"},
      {"reach falls", "reach_m = [7.3, 8.1, 8.9, 10.5]", "reach_m = [7.3, 8.9, 8.1, 10.5]", "braking.reach_m", "rise"},
      {"reach of three", "reach_m = [7.3, 8.1, 8.9, 10.5]", "reach_m = [7.3, 8.1, 10.5]", "braking.reach_m", "4 numbers"},
      {"reach too short", "reach_m = [7.3, 8.1, 8.9, 10.5]", "reach_m = [7.3, 8.1, 8.9, 10.3]", "braking.reach_m", "implements reach"},
      {"braking falls with speed", "[0, 1.97, 5.94,", "[0, 6.04, 5.94,", "braking.swing.angle_deg", "row 1, column 3: falls with growing speed"},
      {"braking falls with reach", "[0, 2.24, 6.93,", "[0, 1.39, 6.93,", "braking.swing.angle_deg", "row 2, column 2: falls with growing reach"},
      {"braking time falls", "[0, 0.421, 0.776,", "[0, 0.421, 0.401,", "braking.swing.time_s", "falls with growing speed"},
      {"braking row too short", "[0, 1.97, 5.94,", "[0, 5.94,", "braking.swing.angle_deg", "8 numbers"},
      {"negative braking", "[0, 1.97, 5.94,", "[-1, 1.97, 5.94,", "braking.swing.angle_deg", "outside"},
      {"no such link", "link = \"stick\"", "link = \"arm\"", "part[2].link", "'arm' is not one of boom, stick, bucket"},
      {"link not covered", "link = \"stick\"", "link = \"boom\"", "part", "none covers the stick"},
      {"part without width", "half_width = 0.60", "half_width = 0.0", "part[3].half_width", "outside"},
      {"outline not convex", "[-0.70, 0.15], [-0.30, -0.25]", "[-0.70, 0.15], [-0.30, 0.20]", "part[2].outline", "not convex"},
      {"outline clockwise", "[[-0.25, -0.30], [0.40, -0.30], [3.00, 0.55], [2.90, 1.25], [2.20, 1.20], [-0.25, 0.30]]",
       "[[-0.25, 0.30], [2.20, 1.20], [2.90, 1.25], [3.00, 0.55], [0.40, -0.30], [-0.25, -0.30]]", "part[0].outline", "counter-clockwise"},
      {"outline a star", "[[-0.25, -0.30], [0.40, -0.30], [3.00, 0.55], [2.90, 1.25], [2.20, 1.20], [-0.25, 0.30]]",
       "[[0.0, 1.0], [-0.588, -0.809], [0.951, 0.309], [-0.951, 0.309], [0.588, -0.809]]", "part[0].outline", "not convex"},
      {"outline straight", "[0.40, -0.45], [1.10, -0.45]", "[0.40, -0.45], [0.75, -0.45], [1.10, -0.45]", "part[3].outline", "3 to 8 points"},
      {"outline with a straight corner", "[2.90, -0.25], [3.05, 0.00]", "[2.90, -0.25], [3.05, -0.25]", "part[2].outline", "not convex"},
      {"half a millimetre", "[0.40, -0.45]", "[0.4005, -0.45]", "part[3].outline", "whole millimetre"},
      {"three scanners", "[kernel]", "[[scanner]]\nposition = [0.0, 0.0, 3.0]\npan_range_deg = [-1.0, 1.0]\npan_rate_max_deg_s = 10.0\n[kernel]", "scanner", "two"},
      {"scanner in the ground", "position = [1.30, 1.35, 3.30]", "position = [1.30, 1.35, -0.1]", "scanner[0].position", "0 .. 8"},
      {"pan range the wrong way", "pan_range_deg = [-45.0, 130.0]", "pan_range_deg = [130.0, -20.0]", "scanner[0].pan_range_deg", "not below"},
      {"hold above the contract's", "request_hold = 0.05", "request_hold = 0.06", "kernel.request_hold", "outside 0.01 .. 0.05"},
      {"silence above the contract's", "request_silent = 0.5", "request_silent = 0.6", "kernel.request_silent", "outside 0.05 .. 0.5"},
      {"generation above freshness", "generation = 1.0", "generation = 30.0", "kernel.generation", "above fresh"},
      {"five lidars", "[tail] ", lidar() + lidar() + lidar() + lidar() + lidar() + "[tail] ", "lidar", "5 lidars, up to 4 are taken"},
      {"lidar in the ground", "[tail] ", lidar("-0.1") + "[tail] ", "lidar[0].position", "0 .. 8"},
      {"lidar without a yaw", "[tail] ", lidar("3.0", "") + "[tail] ", "lidar[0].yaw_deg", "is missing"},
      {"lidar turned over", "[tail] ", lidar("3.0", "yaw_deg = 181.0\n") + "[tail] ", "lidar[0].yaw_deg", "outside"},
      {"no workspace", "[workspace] ", "[yard] ", "workspace", "is missing"},
      {"region within the own body", "radius = 12.0 ", "radius = 3.0 ", "workspace.radius", "is not above kinematics.own_body_radius"},
      {"region beyond the map", "radius = 12.0 ", "radius = 15.1 ", "workspace.radius", "outside"},
      {"a rise that a stone makes", "rise = 0.5 ", "rise = 0.05 ", "workspace.rise", "outside"},
      {"comparisons too seldom", "period = 0.5 ", "period = 1.5 ", "workspace.period", "outside"},
      {"learning too long", "learn = 20.0 ", "learn = 200.0 ", "workspace.learn", "outside"},
      {"part of a voxel", "foreign = 4 ", "foreign = 4.5 ", "workspace.foreign", "whole number"},
      {"lidars compared too seldom", "lidar_period = 0.05", "lidar_period = 1.1", "workspace.lidar_period", "outside 0.01 .. 1"},
      {"lidars waited for too long", "lidar_wait = 0.10", "lidar_wait = 11.0", "workspace.lidar_wait", "outside 0 .. 10"},
      {"no lidar wait", "lidar_wait = 0.10", "", "workspace.lidar_wait", "is missing"},
      {"follows as a number", "follows = true", "follows = 1", "workspace.follows", "true or false"},
      {"no histogram", "histogram = false ", "", "workspace.histogram", "is missing"},
      {"no such separation", "separation = \"reported\"", "separation = \"on\"", "workspace.separation",
       "'on' is not one of none, reported, enforced"},
      {"separation as a flag", "separation = \"reported\"", "separation = true", "workspace.separation", "text"},
      {"nobody approaches so slowly", "approach_speed = 1.6 ", "approach_speed = 0.4 ", "workspace.approach_speed", "outside 0.5 .. 5"},
      {"nobody approaches so fast", "approach_speed = 1.6 ", "approach_speed = 5.1 ", "workspace.approach_speed", "outside 0.5 .. 5"},
      {"intrusion negative", "intrusion_distance = 1.2 ", "intrusion_distance = -0.1 ", "workspace.intrusion_distance", "outside 0 .. 3"},
      {"intrusion longer than anybody", "intrusion_distance = 1.2 ", "intrusion_distance = 3.1 ", "workspace.intrusion_distance", "outside 0 .. 3"},
      {"blind nothing", "blind = 0.5 ", "blind = 0.04 ", "sight.blind", "outside 0.05 .. 1"},
      {"blind more than all", "blind = 0.5 ", "blind = 1.1 ", "sight.blind", "outside 0.05 .. 1"},
      {"dust slows always", "dust_slow = 0.10 ", "dust_slow = 0.0 ", "sight.dust_slow", "outside 0.001 .. 1"},
      {"dust stops before it slows", "dust_stop = 0.30 ", "dust_stop = 0.09 ", "sight.dust_stop", "below dust_slow"},
      {"dust stops above all", "dust_stop = 0.30 ", "dust_stop = 1.01 ", "sight.dust_stop", "outside 0.001 .. 1"},
      {"dust speed none", "dust_speed = 0.40 ", "dust_speed = 0.04 ", "sight.dust_speed", "outside 0.05 .. 1"},
      {"dust dwell negative", "dust_dwell = 3.0 ", "dust_dwell = -0.1 ", "sight.dust_dwell", "outside 0 .. 60"},
      {"dust dwell long", "dust_dwell = 3.0 ", "dust_dwell = 61.0 ", "sight.dust_dwell", "outside 0 .. 60"},
      {"no tail", "[tail] ", "[nose] ", "tail", "is missing"},
      {"watched as text", "watched = false", "watched = \"no\"", "tail.watched", "true or false"},
      {"tail beyond the own body", "radius = 2.9 ", "radius = 3.0 ", "tail.radius", "above kinematics.own_body_radius"},
      {"tail wider than long", "half_width = 1.40", "half_width = 2.95", "tail.half_width", "above radius"},
      {"tail upside down", "underside = 1.00", "underside = 3.00", "tail.top", "not above underside"},
      {"clearance within the own body's rim", "clearance = 0.60", "clearance = 0.40", "tail.clearance", "outside 0.5 .. 3"},
      {"tail fresher for longer than the map", "fresh = 1.0 ", "fresh = 21.0 ", "tail.fresh", "above kernel.fresh"},
      {"joint models of unknown load", "payload_kg = 1799.6", "", "response.payload_kg", "is missing"},
      {"joint models from nowhere", "provenance = \"measured in simulation: berm identify --steps", "source = \"", "response.provenance", "is missing"},
      {"model reaches fall", "reach_m = [5.44, 6.45, 7.45, 9.73]", "reach_m = [5.44, 7.45, 6.45, 9.73]", "response.reach_m", "rise"},
      {"no model reach", "reach_m = [5.44, 6.45, 7.45, 9.73]", "reach_m = []", "response.reach_m", "1 to 8 numbers"},
      {"rates for other reaches", "reach_m = [5.44, 6.45, 7.45, 9.73]", "reach_m = [5.44, 6.45, 7.45]", "response.swing.up.speeding_rad_s2", "3 numbers"},
      {"dead time too long", "dead_time_s = 0.0600", "dead_time_s = 1.1", "response.swing.up.dead_time_s", "outside 0 .. 1"},
      {"lag negative", "\nlag_s = 0.120", "\nlag_s = -0.1", "response.swing.up.lag_s", "outside 0 .. 2"},
      {"lag to zero negative", "stop_lag_s = 0.000", "stop_lag_s = -0.1", "response.swing.up.stop_lag_s", "outside 0 .. 2"},
      {"gain of a wrong unit", "gain = 1.0000", "gain = 57.3", "response.swing.up.gain", "outside 0.5 .. 1.5"},
      {"a joint that never slows", "slowing_rad_s2 = [[1.017", "slowing_rad_s2 = [[0.0", "response.swing.up.slowing_rad_s2", "outside 0.01 .. 20"},
      {"model of one load", "speeding_rad_s2 = [[0.350, 0.350, 0.350, 0.350], ", "speeding_rad_s2 = [", "response.swing.up.speeding_rad_s2", "2 rows"},
      {"model of one direction", "[response.boom.down]", "[response.boom.up_too]", "response.boom.down", "is missing"},
      {"model of no such joint", "[response.stick.up]", "[response.arm.up]", "response.stick.up", "is missing"},
      {"digging faster than the swing", "velocity_max_deg_s = 50.0", "velocity_max_deg_s = 5.0", "kernel.dig_swing_limit_deg_s", "above"},
  };
  return edits;
}

const std::vector<BadEdit>& bad_site_edits() {
  static const std::vector<BadEdit> edits = {
      {"syntax", "[truck]", "[truck", "line", "not valid TOML"},
      {"other schema", "schema = 1", "schema = 0", "schema", "outside 1 .. 1"},
      {"no name", "name = \"bench\"", "", "name", "is missing"},
      {"no dig zone", "[[dig_zone]]", "[dump_zone]", "dig_zone", "0 zones, 1 to 4 are taken"},
      {"zone as table", "[[dig_zone]]", "[dig_zone]", "dig_zone", "array of tables"},
      {"zone the wrong way", "x = [3.9, 10.5]", "x = [10.5, 3.9]", "dig_zone[0].x", "not below"},
      {"zone out of the map", "y = [-4.2, 4.2]", "y = [-4.2, 15.2]", "dig_zone[0].y", "outside -15 .. 15"},
      {"bottomless", "floor = -3.4", "floor = -inf", "dig_zone[0].floor", "outside"},
      {"ceiling below the floor", "ceiling = 1.1", "ceiling = -3.5", "dig_zone[0].ceiling", "outside"},
      {"unknown key", "floor = -3.4", "floor = -3.4\nroof = 1", "dig_zone[0].roof", "not a known key"},
      {"no overpass limit", "pass_over = 0.8 ", "# ", "pass_over", "is missing"},
      {"overpass limit above the map's heights", "pass_over = 0.8 ", "pass_over = 20.1 ", "pass_over", "outside -15 .. 20"},
      {"lower ground out of the map", "y = [5.5, 15.0]", "y = [5.5, 15.1]", "ground_zone[0].y", "outside -15 .. 15"},
      {"lower ground without a limit", "pass_over = -0.9", "", "ground_zone[0].pass_over", "is missing"},
      {"five lower grounds", "[[truck_zone]]",
       "[[ground_zone]]\nx = [0.0, 1.0]\ny = [0.0, 1.0]\npass_over = 1.0\n[[ground_zone]]\nx = [0.0, 1.0]\ny = [0.0, 1.0]\npass_over = 1.0\n[[truck_zone]]", "ground_zone", "5 zones, up to 4 are taken"},
      {"lane without width", "y = [4.5, 9.0]", "y = [9.0, 9.0]", "truck_lane[0].y", "not below"},
      {"lane beyond the map", "y = [4.5, 9.0]", "y = [4.5, 15.5]", "truck_lane[0].y", "outside"},
      {"five lanes", "[[truck_lane]]", four_lanes() + "[[truck_lane]]", "truck_lane", "5 lanes, up to 4 are taken"},
      {"truck zone the wrong way", "x = [-3.3, 4.5]", "x = [4.5, -3.3]", "truck_zone[0].x", "not below"},
      {"truck zone without a ceiling", "ceiling = 1.3 ", "roof = 1.3 ", "truck_zone[0].ceiling", "is missing"},
      {"no truck", "[truck]", "[lorry]", "truck", "is missing"},
      {"truck beyond the map", "centre = [-0.70, 6.75]", "centre = [-0.70, 15.1]", "truck.centre", "outside"},
      {"truck's yaw as text", "yaw_deg = 0.0", "yaw_deg = \"east\"", "truck.yaw_deg", "number"},
      {"truck with a size", "target_kg = 18000.0", "target_kg = 18000.0\nlength = 4.88", "truck.length", "not a known key"},
      {"no target", "target_kg = 18000.0", "", "truck.target_kg", "is missing"},
      {"digging outwards", "radius = [7.4, 5.6]", "radius = [5.6, 7.4]", "dig.radius", "inwards"},
      {"digs without a floor", "floor = -2.65", "", "dig.floor", "is missing"},
      {"digs that go upwards", "floor = -2.65", "floor = 0.5", "dig.floor", "outside"},
      {"benches of no height", "bench_height = 3.0", "bench_height = 0.0", "dig.bench_height", "outside"},
      {"goal under the floor of the digs", "bench_height = 3.0", "bench_height = 3.0\n[[dig.goal]]\nx = [5.0, 7.0]\ny = [0.0, 2.0]\nlevel = -2.7 #", "dig.goal[0].level", "outside"},
      {"goal that slopes under it", "bench_height = 3.0", "bench_height = 3.0\n[[dig.goal]]\nx = [5.0, 7.0]\ny = [0.0, 2.0]\nlevel = -2.6\nslope = [0.1, 0.0] #", "dig.goal[0].slope", "falls to -2.70"},
      {"goal without a level", "bench_height = 3.0", "bench_height = 3.0\n[[dig.goal]]\nx = [5.0, 7.0]\ny = [0.0, 2.0] #", "dig.goal[0].level", "is missing"},
      {"goal with a depth", "bench_height = 3.0", "bench_height = 3.0\n[[dig.goal]]\nx = [5.0, 7.0]\ny = [0.0, 2.0]\nlevel = -2.0\ndepth = 1.0 #", "dig.goal[0].depth", "not a known key"},
      {"nine goals", "bench_height = 3.0", "bench_height = 3.0\n" + nine_goals() + "#", "dig.goal", "9 parts, up to 8 are taken"},
      {"right before left", "swing_deg = [12.0, -12.0]", "swing_deg = [-12.0, 12.0]", "dig.swing_deg", "leftmost first"},
  };
  return edits;
}

}  // namespace berm::config::test

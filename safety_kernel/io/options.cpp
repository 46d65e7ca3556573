#include "io/options.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace berm::kernel {

namespace {

constexpr double kMountMaxM = 30.0;
constexpr double kYawMaxDeg = 360.0;
constexpr double kPi = 3.14159265358979323846;

bool parse_integer(const char* text, long low, long high, long& value) {
  errno = 0;
  char* end = nullptr;
  const long parsed = std::strtol(text, &end, 10);
  if (errno != 0 || end == text || *end != '\0' || parsed < low || parsed > high) return false;
  value = parsed;
  return true;
}

bool parse_mount(const char* text, Vlp16Mount& mount) {
  double field[4];
  const char* at = text;
  for (int i = 0; i < 4; ++i) {
    char* end = nullptr;
    field[i] = std::strtod(at, &end);
    const double limit = i < 3 ? kMountMaxM : kYawMaxDeg;
    if (end == at || !(std::fabs(field[i]) <= limit) || *end != (i < 3 ? ',' : '\0')) return false;
    at = end + 1;
  }
  mount.x_m = field[0];
  mount.y_m = field[1];
  mount.z_m = field[2];
  mount.yaw_rad = field[3] * kPi / 180.0;
  return true;
}

// Takes one option with a value. Returns false when the value is out of its limits; text then says which.
bool take_value(const std::string& name, const char* value, Options& options, bool& known, const char*& limit) {
  long number = 0;
  known = true;
  limit = "must not be empty";
  if (name == "--parameters") return !(options.parameters = value).empty();
  if (name == "--can") return !(options.can = value).empty();
  if (name == "--socket") return !(options.socket = value).empty();
  limit = "must be x,y,z,yaw_deg: metres within 30, degrees within 360";
  if (name == "--vlp16-mount") return parse_mount(value, options.vlp16_mount);
  limit = "must be a port from 1 to 65535";
  if (name == "--scan-port" || name == "--vlp16-port") {
    if (!parse_integer(value, 1, 65535, number)) return false;
    (name == "--scan-port" ? options.scan_port : options.vlp16_port) = static_cast<std::uint16_t>(number);
    return true;
  }
  if (name == "--lidar-port") {
    limit = "must be a port from 1 to 65535, given at most four times";
    if (options.lidar_ports >= BERM_LIDARS || !parse_integer(value, 1, 65535, number)) return false;
    options.lidar_port[options.lidar_ports++] = static_cast<std::uint16_t>(number);
    return true;
  }
  limit = "must be a uid from 0 to 4294967294";
  if (name == "--app-uid" || name == "--recorder-uid" || name == "--journal-uid") {
    if (!parse_integer(value, 0, 4294967294L, number)) return false;
    const uid_t uid = static_cast<uid_t>(number);
    if (name == "--journal-uid") options.journal_uid = uid;
    else (name == "--app-uid" ? options.app_uid : options.recorder_uid) = uid;
    return true;
  }
  limit = "must be a file descriptor from 0 to 1023";
  if (name == "--ready-fd") {
    if (!parse_integer(value, 0, 1023, number)) return false;
    options.ready_fd = static_cast<int>(number);
    return true;
  }
  known = false;
  return false;
}

const char* missing_option(const Options& options) {
  if (options.parameters.empty()) return "--parameters";
  if (options.socket.empty()) return "--socket";
  if (options.map_only) return options.scan_port == 0 && options.vlp16_port == 0 ? "--vlp16-port" : nullptr;
  if (options.can.empty()) return "--can";
  if (options.scan_port == 0) return "--scan-port";
  return nullptr;
}

}  // namespace

OptionsResult parse_options(int argc, const char* const* argv, Options& options, std::string& error) {
  options = Options{};
  options.app_uid = geteuid();
  options.recorder_uid = geteuid();
  bool realtime = false;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--help" || name == "-h") return OptionsResult::kHelp;
    if (name == "--lockstep") {
      options.lockstep = true;
    } else if (name == "--realtime") {
      realtime = true;
    } else if (name == "--map-only") {
      options.map_only = true;
    } else {
      bool known = false;
      const char* limit = nullptr;
      const char* value = i + 1 < argc ? argv[i + 1] : "";
      const bool good = take_value(name, value, options, known, limit);
      if (!known) {
        error = "unknown option " + name + "; --help lists them";
        return OptionsResult::kError;
      }
      if (!good) {
        error = name + " " + limit + ", not \"" + value + "\"";
        return OptionsResult::kError;
      }
      ++i;
    }
  }
  if (options.lockstep && (realtime || options.map_only)) {
    error = std::string("--lockstep cannot go with ") + (realtime ? "--realtime" : "--map-only");
    return OptionsResult::kError;
  }
  // Its packets carry no sign of life that is looked at: with a machine, ground that nobody sees any more would stay fresh.
  if (options.vlp16_port != 0 && !options.map_only) {
    error = "--vlp16-port goes with --map-only alone; lidars of a machine are given by --lidar-port";
    return OptionsResult::kError;
  }
  if (const char* missing = missing_option(options)) {
    error = std::string(missing) + " is required";
    return OptionsResult::kError;
  }
  return OptionsResult::kRun;
}

const char* options_help() {
  return "usage: berm_kernel --parameters FILE --can ADDRESS --scan-port PORT --socket PATH [options]\n"
         "\n"
         "The safety kernel: the only process that talks to machine and sensors.\n"
         "\n"
         "  --parameters FILE      parameter block (made by berm_params from machine and site files)\n"
         "  --can ADDRESS          udp:GROUP:PORT (frames by multicast on loopback) or can:INTERFACE (SocketCAN)\n"
         "  --scan-port PORT       UDP port on 127.0.0.1 for the scan datagrams of the panning scanners\n"
         "  --socket PATH          Unix socket on which app and recorders are given the shared memory\n"
         "  --vlp16-port PORT      UDP port on 127.0.0.1 for native packets of a Velodyne VLP-16; with --map-only alone\n"
         "  --vlp16-mount X,Y,Z,A  its place in the base frame, metres, and its yaw in degrees (0,0,1.8,0)\n"
         "  --lidar-port PORT      UDP port on 127.0.0.1 of a lidar on the upper body; once for each that the parameter block has\n"
         "  --app-uid N            uid the app must have (default: the kernel's own)\n"
         "  --recorder-uid N       uid recorders must have (default: the kernel's own)\n"
         "  --journal-uid N        keeps a journal for a writer (berm_journal) of this uid (default: keeps none)\n"
         "  --lockstep             virtual time from the plant's clock frames\n"
         "  --realtime             the wall clock (default)\n"
         "  --map-only             no machine: stays in INIT, fills the map, serves recorders\n"
         "  --ready-fd N           writes one byte there when everything is open\n"
         "  --help                 this text\n"
         "\n"
         "At SIGTERM or SIGINT it prints one line of JSON on stdout and exits 0.\n";
}

}  // namespace berm::kernel

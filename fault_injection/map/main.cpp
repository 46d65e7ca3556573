// berm map: plays a recorded lidar capture, packet by packet over UDP, into a running kernel and shows the kernel's height map.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "config/command_line.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "contract/berm_contract.h"
#include "map/pcap_capture.hpp"
#include "run/contract_text.hpp"
#include "run/kernel_session.hpp"
#include "run/map_picture.hpp"
#include "run/parameter_file.hpp"
#include "run/recorder.hpp"
#include "run/reserved_port.hpp"

namespace berm::run {
namespace {

constexpr std::size_t kVlp16Bytes = 1206;
constexpr double kLongestGap_s = 3600.0;  // the sensor's own clock begins anew every hour: what comes later is another recording

struct Options {
  std::string file;
  std::string machine = "zx200";
  std::string site = "bench";
  std::string json;
  std::string picture = "map.svg";
  std::string mount = "0,0,1.8,0";
  std::uint16_t port = 2368;
  double speed = 1.0;
};

// A gap is waited for as it was recorded: one of years, of a wrong clock, would never end.
void check_rhythm(const std::string& file, const std::vector<CapturedDatagram>& datagrams) {
  double latest_s = datagrams.front().time_s;
  for (const auto& datagram : datagrams) {
    if (datagram.time_s - latest_s > kLongestGap_s)
      throw std::runtime_error(fmt::format("{}: packet {}: time: {:.0f} s after what came before, more than {:.0f}", file, datagram.packet, datagram.time_s - latest_s, kLongestGap_s));
    latest_s = std::max(latest_s, datagram.time_s);
  }
}

// Sends the datagrams in the rhythm of the recording. Returns how many went out.
std::size_t play(const std::vector<CapturedDatagram>& datagrams, std::uint16_t kernel_port, double speed) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(kernel_port);
  if (fd < 0 || connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof to) != 0) throw std::runtime_error("no UDP socket on loopback");
  const auto begin = std::chrono::steady_clock::now();
  std::size_t sent = 0;
  for (const auto& datagram : datagrams) {
    const double due = std::max(0.0, datagram.time_s - datagrams.front().time_s) / speed;
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(due)));
    if (send(fd, datagram.payload.data(), datagram.payload.size(), 0) == static_cast<ssize_t>(datagram.payload.size())) ++sent;
    if (isatty(2) && sent % 100 == 0) config::print_error("\r{} of {} packets", sent, datagrams.size());
  }
  if (isatty(2)) config::print_error("\r{} packets played        \n", sent);
  close(fd);
  return sent;
}

nlohmann::json cells_of(const MapSnapshot& map) {
  auto cells = nlohmann::json::array();
  for (int iy = 0; iy < BERM_MAP_CELLS; ++iy) {
    for (int ix = 0; ix < BERM_MAP_CELLS; ++ix) {
      const auto i = static_cast<std::size_t>(iy * BERM_MAP_CELLS + ix);
      if (map.status[i] == BERM_CELL_UNKNOWN) continue;
      cells.push_back({{"x_m", map.origin_m + (ix + 0.5) * map.cell_m},
                       {"y_m", map.origin_m + (iy + 0.5) * map.cell_m},
                       {"height_m", map.height_mm[i] * 1e-3},
                       {"status", cell_status_name(map.status[i])}});
    }
  }
  return cells;
}

void draw(const std::string& path, const std::string& file, const MapSnapshot& map) {
  const double half = -map.origin_m;
  SvgPanel panel(-half, -half, half, half, 60, 40, 20.0);
  const auto range = height_range(map);
  draw_map(panel, map, range);
  panel.circle(0, 0, 0.2, "fill:none;stroke:#c00;stroke-width:2");
  panel.axes(5.0, "x (m)", "y (m)");
  panel.title("Height map of the kernel: " + file.substr(file.rfind('/') + 1));
  write_svg(path, panel.pixel_width() + 90, panel.pixel_height() + 130, {&panel}, colour_bar(60, panel.pixel_height() + 90, panel.pixel_width(), range));
}

int run(const Options& options) {
  const std::string machine = find_machine(options.machine), site = find_site(options.site);
  config::expect_apart({{"--json", options.json}, {"--picture", options.picture}}, {{"--machine", machine}, {"--site", site}});
  const auto capture = read_capture(options.file);
  std::vector<CapturedDatagram> datagrams;
  for (const auto& datagram : capture)
    if (datagram.destination_port == options.port) datagrams.push_back(datagram);
  const auto native = std::count_if(datagrams.begin(), datagrams.end(), [](const auto& d) { return d.payload.size() == kVlp16Bytes; });
  if (native == 0)
    throw std::runtime_error(fmt::format("{}: no lidar packet: none of its {} UDP datagrams is {} bytes to port {}", options.file, capture.size(), kVlp16Bytes, options.port));
  check_rhythm(options.file, datagrams);

  const RunFolder folder;
  const auto uids = choose_uids();
  expect_reachable(folder, uids);
  const std::string parameters = folder.file("kernel.params");
  compile_parameter_file(machine, site, parameters);
  const ReservedPort port;
  ChildProcess kernel;
  start_kernel(kernel, folder, uids, parameters, {"--map-only", "--vlp16-port", port.text(), "--vlp16-mount", options.mount});
  Recorder recorder;
  recorder.connect(folder.file("kernel.sock"));
  const std::size_t sent = play(datagrams, port.number(), options.speed);
  // Every row of the map is published again within this many cycles; then the picture is complete.
  const auto done = recorder.segment()->wake + 60;
  while (static_cast<std::int32_t>(__atomic_load_n(&recorder.segment()->wake, __ATOMIC_ACQUIRE) - done) < 0 && !kernel.ended()) recorder.poll(0.05);
  const auto map = recorder.map();
  kernel.signal(SIGTERM);
  if (!kernel.wait_ended(5.0)) throw std::runtime_error("the kernel does not end");
  const auto report = nlohmann::json::parse(last_json_line(kernel.take_lines()), nullptr, false);
  if (report.is_discarded()) throw std::runtime_error("the kernel ended without its report: " + kernel.describe_end());

  const auto packets = report.value("vlp16_packets", 0ULL);
  const auto rejected = report.value("vlp16_rejected", 0ULL);
  const auto points = report.value("vlp16_points", 0ULL);
  const auto cells = cells_of(map);
  if (!options.json.empty()) {
    const nlohmann::json result{{"file", options.file}, {"packets", packets}, {"rejected", rejected}, {"points", points}, {"cell_m", map.cell_m}, {"cells", cells}};
    config::write_whole_file(options.json, config::json_text(result, 1));
  }
  draw(options.picture, options.file, map);
  fmt::print("{} packets into the kernel, {} rejected, {} points, {} cells of {:.1f} m observed\npicture: {}\n", packets, rejected, points, cells.size(), map.cell_m,
             options.picture);
  if (packets + rejected != sent) throw std::runtime_error(fmt::format("{} packets were sent and {} arrived: play more slowly (--speed)", sent, packets + rejected));
  return rejected == 0 ? 0 : 1;
}

}  // namespace
}  // namespace berm::run

int main(int argc, char** argv) {
  berm::run::Options options;
  CLI::App app{"Plays a recorded Velodyne VLP-16 capture (pcap or pcapng) over UDP into a running kernel and shows the kernel's height map.", "berm map"};
  app.add_option("FILE", options.file, "capture with native packets of 1206 bytes")->required();
  berm::config::output(app.add_option("--json", options.json, "write packets, rejected, points, cell_m, cells (x_m, y_m, height_m, status)"));
  berm::config::output(app.add_option("--picture", options.picture, "where the picture goes (SVG)"))->capture_default_str();
  app.add_option("--mount", options.mount, "the lidar's place in the base frame: x,y,z in metres, yaw in degrees")->capture_default_str();
  app.add_option("--port", options.port, "UDP port of the packets in the capture")->capture_default_str()->check(CLI::Range(1, 65535));
  app.add_option("--speed", options.speed, "times the recorded rhythm")->capture_default_str()->check(CLI::Range(0.01, 100.0));
  app.add_option("--machine", options.machine, "machine profile: a name or a TOML file")->capture_default_str();
  app.add_option("--site", options.site, "site: a name or a TOML file")->capture_default_str();
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  try {
    return berm::run::run(options);
  } catch (const berm::run::ToldAlready&) {
    return 2;
  } catch (const std::exception& error) {
    berm::config::print_error("berm map: {}\n", error.what());
    return 2;
  }
}

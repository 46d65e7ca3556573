#include "points/lms111.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "points/file_bytes.hpp"

namespace berm::app {
namespace {

constexpr double kRangeLimitM = 1000.0;

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string bytes_of(const std::string& text, const std::string& name, std::size_t packet) {
  std::string bytes;
  bytes.reserve(text.size() / 3 + 1);
  for (std::size_t i = 0; i < text.size(); i += 3) {
    const int high = digit(text[i]), low = i + 1 < text.size() ? digit(text[i + 1]) : -1;
    if (high < 0 || low < 0 || (i + 2 < text.size() && (text[i + 2] != ':' || i + 3 == text.size())))
      throw PointFileError(fmt::format("{}: packet {}: tcp.payload: is no colon-separated hexadecimal", name, packet));
    bytes.push_back(static_cast<char>(high << 4 | low));
  }
  return bytes;
}

const nlohmann::json* member(const nlohmann::json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

std::string text_of(const nlohmann::json* tcp, const char* key) {
  const nlohmann::json* value = member(tcp, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

}  // namespace

std::vector<LmsScan> parse_lms_scans(std::string_view bytes, const std::string& name) {
  const auto packets = nlohmann::json::parse(bytes, nullptr, false);
  if (packets.is_discarded() || !packets.is_array()) throw PointFileError(fmt::format("{}: packets: no JSON list", name));
  std::map<std::string, ColaStream> streams;
  std::vector<LmsScan> scans;
  std::size_t number = 0;
  for (const auto& packet : packets) {
    ++number;
    const nlohmann::json* tcp = member(member(member(&packet, "_source"), "layers"), "tcp");
    const nlohmann::json* payload = member(tcp, "tcp.payload");
    if (payload == nullptr) continue;
    if (!payload->is_string()) throw PointFileError(fmt::format("{}: packet {}: tcp.payload: is no text", name, number));
    ColaStream& stream = streams.try_emplace(text_of(tcp, "tcp.stream") + "/" + text_of(tcp, "tcp.srcport"), name).first->second;
    stream.add(bytes_of(payload->get_ref<const std::string&>(), name, number));
    while (const auto body = stream.next())
      if (auto scan = parse_lmd_scandata(*body, name)) scans.push_back(std::move(*scan));
  }
  for (const auto& [ports, stream] : streams)
    if (!stream.idle()) throw PointFileError(fmt::format("{}: telegram: the recording ends within the last one", name));
  if (scans.empty()) throw PointFileError(fmt::format("{}: scans: no LMDscandata telegram in {} packets", name, number));
  return scans;
}

PointCloud lms_points(const std::vector<LmsScan>& scans, const std::string& name) {
  PointCloud cloud;
  cloud.file = name;
  cloud.format = "lms";
  std::uint32_t scanline = 0;
  double wrapped_us = 0.0;
  for (std::size_t s = 0; s < scans.size(); ++s, ++scanline) {
    const LmsScan& scan = scans[s];
    if (s > 0 && scan.since_startup_us < scans[s - 1].since_startup_us) {
      if (scans[s - 1].since_startup_us - scan.since_startup_us < 0x80000000U)
        throw PointFileError(fmt::format("{}: scan {}: time since startup: runs backwards", name, s + 1));
      wrapped_us += 4294967296.0;
    }
    const double time_s = 1e-6 * (wrapped_us + scan.since_startup_us);
    const LmsChannel* first = nullptr;
    std::vector<float> farthest;
    for (const LmsChannel& channel : scan.channels) {
      if (channel.content.substr(0, 4) != "DIST") continue;
      if (first == nullptr) {
        first = &channel;
        farthest = channel.value;
      } else if (channel.value.size() == farthest.size() && channel.start_rad == first->start_rad && channel.step_rad == first->step_rad) {
        for (std::size_t i = 0; i < farthest.size(); ++i) farthest[i] = std::max(farthest[i], channel.value[i]);
      }
    }
    if (first == nullptr) throw PointFileError(fmt::format("{}: scan {}: channels: no distances", name, s + 1));
    for (std::size_t i = 0; i < farthest.size(); ++i) {
      const double range = 1e-3 * static_cast<double>(farthest[i]);
      if (range <= 0.0) continue;
      if (range > kRangeLimitM) throw PointFileError(fmt::format("{}: scan {}: distance: beyond {:g} m", name, s + 1, kRangeLimitM));
      const double angle = first->start_rad + static_cast<double>(i) * first->step_rad;
      cloud.points.push_back({static_cast<float>(range * std::cos(angle)), static_cast<float>(range * std::sin(angle)), 0.0F, scanline, time_s});
    }
  }
  return cloud;
}

PointCloud parse_lms(std::string_view bytes, const std::string& name) { return lms_points(parse_lms_scans(bytes, name), name); }

PointCloud read_lms(const std::string& path) { return parse_lms(read_file_bytes(path), path); }

}  // namespace berm::app

#include "points/cola_b.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "points/point_cloud.hpp"

namespace berm::app {
namespace {

constexpr std::string_view kFrame("\x02\x02\x02\x02", 4);
constexpr double kPi = 3.14159265358979323846;
constexpr double kAngle = kPi / 180.0 / 10000.0;  // angles are sent in 1/10000 degree
constexpr unsigned kChannels = 16;                // of 16 bits, and as many of 8

std::uint32_t big32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

class Reader {
public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::uint32_t number(std::size_t size, const char* field) {
    if (bytes_.size() - at_ < size) fail(field, fmt::format("the telegram of {} bytes ends before", bytes_.size()));
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += size;
    return value;
  }
  double real(const char* field) {
    const std::uint32_t bits = number(4, field);
    float value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value) || std::abs(value) > 1e6F) fail(field, "is not finite or beyond 1e6");
    return static_cast<double>(value);
  }
  std::string text(std::size_t size, const char* field) {
    if (bytes_.size() - at_ < size) fail(field, fmt::format("the telegram of {} bytes ends before", bytes_.size()));
    at_ += size;
    return std::string(bytes_.substr(at_ - size, size));
  }
  void skip(std::size_t size, const char* field) { text(size, field); }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const char* field, const std::string& why) const { throw PointFileError(fmt::format("{}: LMDscandata {}: {}", name_, field, why)); }

private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

void read_channels(Reader& in, std::size_t value_bytes, LmsScan& scan) {
  const unsigned channels = in.number(2, "channels");
  if (channels > kChannels) in.fail("channels", fmt::format("{} claimed, {} allowed", channels, kChannels));
  for (unsigned c = 0; c < channels; ++c) {
    LmsChannel channel;
    channel.content = in.text(5, "content");
    const double scale = in.real("scale factor"), offset = in.real("scale offset");
    const auto start = static_cast<std::int32_t>(in.number(4, "start angle"));
    if (std::abs(static_cast<double>(start)) > 7'200'000.0) in.fail("start angle", "beyond 720 degrees");
    channel.start_rad = start * kAngle;
    channel.step_rad = in.number(2, "angular step") * kAngle;
    const std::size_t count = in.number(2, "values");
    if (count * value_bytes > in.left()) in.fail("values", fmt::format("{} claimed and {} bytes are there", count, in.left()));
    if (count > 1 && channel.step_rad == 0.0) in.fail("angular step", "is 0");
    channel.value.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t raw = in.number(value_bytes, "values");
      channel.value.push_back(raw == 0 ? 0.0F : static_cast<float>(raw * scale + offset));
    }
    scan.channels.push_back(std::move(channel));
  }
}

// The clock stands behind position, name and comment, whose lengths the listing gives for their absence only.
std::optional<double> read_clock(Reader& in) {
  if (in.left() < 8) return std::nullopt;
  for (const char* field : {"position", "name", "comment"})
    if (in.number(2, field) != 0) return std::nullopt;
  if (in.number(2, "time") == 0) return std::nullopt;
  in.skip(4, "date");
  const double hour = in.number(1, "hour"), minute = in.number(1, "minute"), second = in.number(1, "second");
  const double microsecond = in.number(4, "microsecond");
  if (hour > 23 || minute > 59 || second > 60 || microsecond >= 1e6) in.fail("time", "is no time of day");
  return hour * 3600.0 + minute * 60.0 + second + microsecond * 1e-6;
}

}  // namespace

void ColaStream::add(std::string_view bytes) {
  waiting_.erase(0, used_);
  used_ = 0;
  waiting_.append(bytes);
}

std::optional<std::string_view> ColaStream::next() {
  if (telegrams_ == 0) used_ = std::min(std::string_view(waiting_).find(kFrame), waiting_.size() - std::min<std::size_t>(3, waiting_.size()));
  const std::string_view bytes = std::string_view(waiting_).substr(used_);
  if (bytes.size() < 4 && telegrams_ == 0) return std::nullopt;
  const auto fail = [&](const std::string& what) { throw PointFileError(fmt::format("{}: telegram {}: {}", name_, telegrams_ + 1, what)); };
  if (bytes.substr(0, 4) != kFrame.substr(0, std::min<std::size_t>(4, bytes.size()))) fail("frame: is not 02 02 02 02");
  if (bytes.size() < 8) return std::nullopt;
  const std::size_t length = big32(bytes, 4);
  if (length > kColaTelegramBytes) fail(fmt::format("length: {} bytes claimed, {} allowed", length, kColaTelegramBytes));
  if (bytes.size() < 8 + length + 1) return std::nullopt;
  const std::string_view body = bytes.substr(8, length);
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  if (sum != static_cast<unsigned char>(bytes[8 + length])) fail("checksum: is wrong");
  ++telegrams_;
  used_ += 8 + length + 1;
  return body;
}

std::optional<LmsScan> parse_lmd_scandata(std::string_view body, const std::string& name) {
  constexpr std::string_view kSent = "sSN LMDscandata ", kAnswered = "sRA LMDscandata ";
  if (body.substr(0, kSent.size()) != kSent && body.substr(0, kAnswered.size()) != kAnswered) return std::nullopt;
  Reader in(body.substr(kSent.size()), name);
  LmsScan scan;
  in.skip(2 + 2 + 4 + 2 + 2, "version, device, serial number, status, telegram counter");
  scan.scan_counter = static_cast<std::uint16_t>(in.number(2, "scan counter"));
  scan.since_startup_us = in.number(4, "time since startup");
  in.skip(4 + 2 + 2 + 2, "time of transmission, inputs, outputs, layer angle");
  scan.scan_rate_hz = 0.01 * in.number(4, "scan frequency");
  in.skip(4, "measurement frequency");
  const std::size_t encoders = in.number(2, "encoders");
  if (encoders * 6 > in.left()) in.fail("encoders", fmt::format("{} claimed and {} bytes are there", encoders, in.left()));
  in.skip(encoders * 6, "encoders");
  read_channels(in, 2, scan);
  read_channels(in, 1, scan);
  scan.clock_s = read_clock(in);
  return scan;
}

}  // namespace berm::app

// SICK's CoLa-B: telegrams out of a byte stream, and the scan in an LMDscandata telegram; written from SICK's telegram listing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace berm::app {

constexpr std::size_t kColaTelegramBytes = 1 << 20;  // the longest body taken

// 02 02 02 02, length (32 bits, big-endian), body, exclusive or of the body's bytes. Bytes before the first telegram are passed over: a recording may
// begin within one. Throws PointFileError for a wrong frame, length or checksum.
class ColaStream {
public:
  explicit ColaStream(std::string name) : name_(std::move(name)) {}
  void add(std::string_view bytes);
  // The next whole body; none until more bytes come. Valid until the next call of add or next.
  std::optional<std::string_view> next();
  bool idle() const { return used_ == waiting_.size(); }  // no telegram is begun

private:
  std::string name_;
  std::string waiting_;
  std::size_t used_ = 0;
  std::size_t telegrams_ = 0;
};

// A channel's values as the scanner scaled them: distances in millimetres, or remission.
struct LmsChannel {
  std::string content;  // "DIST1", "RSSI1", ...
  double start_rad = 0.0;
  double step_rad = 0.0;
  std::vector<float> value;  // 0: no return
};

struct LmsScan {
  std::uint16_t scan_counter = 0;
  std::uint32_t since_startup_us = 0;    // begins anew after 2^32
  std::optional<double> clock_s;         // of the scanner's own day, when it is sent
  double scan_rate_hz = 0.0;
  std::vector<LmsChannel> channels;
};

// None when body is another telegram. name stands for the file in errors; throws PointFileError for a malformed scan.
std::optional<LmsScan> parse_lmd_scandata(std::string_view body, const std::string& name);

}  // namespace berm::app

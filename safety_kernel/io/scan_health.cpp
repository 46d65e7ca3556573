#include "io/scan_health.hpp"

namespace berm::kernel {

bool ScanHealth::accept(const berm_scan_packet& packet, std::int64_t now_us) {
  if (packet.scanner >= kScanners || (packet.flags & (BERM_SCAN_FLAG_WINDOW_DIRTY | BERM_SCAN_FLAG_HEAD_FAULT)) != 0) return false;
  if (packet.time_us > static_cast<std::uint64_t>(now_us + kFutureMaxUs)) return false;
  if (now_us - static_cast<std::int64_t>(packet.time_us) > kAgeMaxUs) return false;
  const bool first = heard_us_[packet.scanner] < 0;
  const std::uint32_t ahead = packet.sequence - sequence_[packet.scanner];
  if (!first && (ahead == 0 || ahead > 0x7FFFFFFFU)) return false;
  sequence_[packet.scanner] = packet.sequence;
  heard_us_[packet.scanner] = now_us;
  return true;
}

bool ScanHealth::silent(std::int64_t now_us, std::int32_t limit_us) const {
  if (!both_heard()) return false;
  return now_us - heard_us_[0] > limit_us || now_us - heard_us_[1] > limit_us;
}

}  // namespace berm::kernel

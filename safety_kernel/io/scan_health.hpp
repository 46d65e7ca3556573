// Whether each panning scanner is alive: which packets may be used, and since when none came.
#pragma once

#include <cstdint>

#include "scan/scan_packet.h"

namespace berm::kernel {

class ScanHealth {
 public:
  static constexpr int kScanners = 2;
  static constexpr std::int64_t kAgeMaxUs = 100000;   // first sample to arrival; a packet spans 10 ms
  static constexpr std::int64_t kFutureMaxUs = 2000;  // between the clocks of scanner and kernel

  // True when the packet may be used: newer than the one before it, sampled just now, window and head good. Replayed, late and
  // re-ordered packets are not, and a scanner that sends only such is silent.
  bool accept(const berm_scan_packet& packet, std::int64_t now_us);

  bool both_heard() const { return heard_us_[0] >= 0 && heard_us_[1] >= 0; }
  // No usable packet of some scanner for longer than the limit. Counts from the moment both were first heard.
  bool silent(std::int64_t now_us, std::int32_t limit_us) const;

 private:
  std::int64_t heard_us_[kScanners] = {-1, -1};
  std::uint32_t sequence_[kScanners] = {};
};

}  // namespace berm::kernel

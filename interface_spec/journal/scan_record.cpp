#include "journal/scan_record.hpp"

#include "journal/journal_record.h"

namespace berm::record {

bool take_scan(ByteReader& from, berm_scan_packet& to) {
  berm_journal_scan scan{};
  if (!from.copy(scan) || scan.count > BERM_SCAN_PACKET_SAMPLES || scan.echoes_per_sample > BERM_SCAN_ECHOES) return false;
  to = berm_scan_packet{};
  to.scanner = scan.scanner;
  to.flags = scan.flags;
  to.sequence = scan.sequence;
  to.scanline = scan.scanline;
  to.time_us = scan.time_us;
  to.sample_period_ns = scan.sample_period_ns;
  to.pan_start_urad = scan.pan_start_urad;
  to.pan_end_urad = scan.pan_end_urad;
  to.first_index = scan.first_index;
  to.samples_per_revolution = scan.samples_per_revolution;
  to.count = scan.count;
  to.echoes_per_sample = scan.echoes_per_sample;
  to.window_percent = scan.window_percent;
  const std::size_t bytes = static_cast<std::size_t>(scan.count) * scan.echoes_per_sample * 2U;
  const std::uint8_t* padded = from.raw(up8(bytes));
  if (padded == nullptr) return false;
  ByteReader ranges(padded, bytes);
  for (int i = 0; i < scan.count; ++i)
    for (int echo = 0; echo < scan.echoes_per_sample; ++echo) to.range[i][echo] = ranges.u16();
  std::uint8_t datagram[BERM_SCAN_PACKET_MAX_BYTES];
  return berm_scan_encode(&to, datagram) != 0;  // every field within the range the kernel's decoder lets through
}

}  // namespace berm::record

// A packet in which every field and every sample is different.
#pragma once

#include "scan/scan_packet.h"

inline berm_scan_packet sample_packet(std::uint16_t count = BERM_SCAN_PACKET_SAMPLES, std::uint8_t echoes = BERM_SCAN_ECHOES) {
  berm_scan_packet p{};
  p.scanner = 1;
  p.flags = BERM_SCAN_FLAG_LAST | BERM_SCAN_FLAG_HEAD_FAULT;
  p.sequence = 0x01020304;
  p.scanline = 0x05060708;
  p.time_us = 0x1112131415161718;
  p.sample_period_ns = 83333;
  p.pan_start_urad = -1234567;
  p.pan_end_urad = 1345678;
  p.first_index = 250;
  p.samples_per_revolution = 400;
  p.count = count;
  p.echoes_per_sample = echoes;
  p.window_percent = 97;
  for (int i = 0; i < count; ++i)
    for (int e = 0; e < echoes; ++e) p.range[i][e] = static_cast<std::uint16_t>(1000 + 7 * i + 1013 * e);
  return p;
}

// Codec of the scan datagram (SCAN.md).
#include "scan/scan_packet.h"

namespace {

constexpr size_t kCrcBytes = 4;
constexpr uint16_t kKnownFlags = BERM_SCAN_FLAG_FIRST | BERM_SCAN_FLAG_LAST | BERM_SCAN_FLAG_WINDOW_DIRTY | BERM_SCAN_FLAG_HEAD_FAULT;
constexpr int32_t kPanMax = 6283186;  // one turn, urad

void put(uint8_t* at, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<uint8_t>(value >> (8 * i));
}

uint64_t get(const uint8_t* at, int bytes) {
  uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value |= static_cast<uint64_t>(at[i]) << (8 * i);
  return value;
}

// The type's invariant.
bool fields_in_range(const berm_scan_packet& p) {
  return p.scanner <= 1 && (p.flags & ~kKnownFlags) == 0 && p.sample_period_ns >= 1 && p.sample_period_ns <= 10000000u && p.pan_start_urad >= -kPanMax &&
         p.pan_start_urad <= kPanMax && p.pan_end_urad >= -kPanMax && p.pan_end_urad <= kPanMax && p.count >= 1 && p.count <= BERM_SCAN_PACKET_SAMPLES &&
         p.samples_per_revolution >= 1 && static_cast<uint32_t>(p.first_index) + p.count <= p.samples_per_revolution && p.echoes_per_sample >= 1 &&
         p.echoes_per_sample <= BERM_SCAN_ECHOES && p.window_percent <= 100 && p.time_us <= static_cast<uint64_t>(INT64_MAX);
}

size_t body_bytes(const berm_scan_packet& p) { return BERM_SCAN_HEADER_BYTES + static_cast<size_t>(p.count) * p.echoes_per_sample * 2; }

}  // namespace

extern "C" {

size_t berm_scan_encode(const berm_scan_packet* p, uint8_t* out) {
  if (!fields_in_range(*p)) return 0;
  for (size_t i = 0; i < BERM_SCAN_HEADER_BYTES; ++i) out[i] = 0;
  put(out, BERM_SCAN_PACKET_MAGIC, 4);
  out[4] = BERM_SCAN_PACKET_VERSION;
  out[5] = p->scanner;
  put(out + 6, p->flags, 2);
  put(out + 8, p->sequence, 4);
  put(out + 12, p->scanline, 4);
  put(out + 16, p->time_us, 8);
  put(out + 24, p->sample_period_ns, 4);
  put(out + 28, static_cast<uint32_t>(p->pan_start_urad), 4);
  put(out + 32, static_cast<uint32_t>(p->pan_end_urad), 4);
  put(out + 36, p->first_index, 2);
  put(out + 38, p->samples_per_revolution, 2);
  put(out + 40, p->count, 2);
  out[42] = p->echoes_per_sample;
  out[43] = p->window_percent;
  uint8_t* at = out + BERM_SCAN_HEADER_BYTES;
  for (int i = 0; i < p->count; ++i)
    for (int echo = 0; echo < p->echoes_per_sample; ++echo, at += 2) put(at, p->range[i][echo], 2);
  const size_t body = body_bytes(*p);
  put(out + body, berm_crc32c(out, body), kCrcBytes);
  return body + kCrcBytes;
}

int berm_scan_decode(const uint8_t* bytes, size_t n, berm_scan_packet* p) {
  if (n < BERM_SCAN_HEADER_BYTES + 2 + kCrcBytes || n > BERM_SCAN_PACKET_MAX_BYTES) return BERM_SCAN_LENGTH;
  if (get(bytes, 4) != BERM_SCAN_PACKET_MAGIC) return BERM_SCAN_MAGIC;
  if (bytes[4] != BERM_SCAN_PACKET_VERSION) return BERM_SCAN_VERSION;
  if (get(bytes + n - kCrcBytes, kCrcBytes) != berm_crc32c(bytes, n - kCrcBytes)) return BERM_SCAN_CRC;
  berm_scan_packet in{};
  in.scanner = bytes[5];
  in.flags = static_cast<uint16_t>(get(bytes + 6, 2));
  in.sequence = static_cast<uint32_t>(get(bytes + 8, 4));
  in.scanline = static_cast<uint32_t>(get(bytes + 12, 4));
  in.time_us = get(bytes + 16, 8);
  in.sample_period_ns = static_cast<uint32_t>(get(bytes + 24, 4));
  in.pan_start_urad = static_cast<int32_t>(static_cast<uint32_t>(get(bytes + 28, 4)));
  in.pan_end_urad = static_cast<int32_t>(static_cast<uint32_t>(get(bytes + 32, 4)));
  in.first_index = static_cast<uint16_t>(get(bytes + 36, 2));
  in.samples_per_revolution = static_cast<uint16_t>(get(bytes + 38, 2));
  in.count = static_cast<uint16_t>(get(bytes + 40, 2));
  in.echoes_per_sample = bytes[42];
  in.window_percent = bytes[43];
  if (!fields_in_range(in)) return BERM_SCAN_FIELD;
  for (size_t i = 44; i < BERM_SCAN_HEADER_BYTES; ++i)
    if (bytes[i] != 0) return BERM_SCAN_FIELD;
  if (n != body_bytes(in) + kCrcBytes) return BERM_SCAN_LENGTH;
  const uint8_t* at = bytes + BERM_SCAN_HEADER_BYTES;
  for (int i = 0; i < in.count; ++i)
    for (int echo = 0; echo < in.echoes_per_sample; ++echo, at += 2) in.range[i][echo] = static_cast<uint16_t>(get(at, 2));
  *p = in;
  return BERM_SCAN_OK;
}

const char* berm_scan_result_text(int result) {
  switch (result) {
    case BERM_SCAN_OK: return "ok";
    case BERM_SCAN_LENGTH: return "wrong length";
    case BERM_SCAN_MAGIC: return "no scan packet";
    case BERM_SCAN_VERSION: return "another version";
    case BERM_SCAN_CRC: return "wrong CRC";
    case BERM_SCAN_FIELD: return "field out of range";
    default: return "unknown result";
  }
}

}  // extern "C"

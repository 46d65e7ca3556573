// CRC-32 (IEEE 802.3) and CRC-32C (Castagnoli), both reflected, by table.
#include <array>

#include "scan/scan_packet.h"

namespace {

using Table = std::array<uint32_t, 256>;

constexpr Table make_table(uint32_t polynomial) {
  Table table{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) ? (crc >> 1) ^ polynomial : crc >> 1;
    table[byte] = crc;
  }
  return table;
}

constexpr Table kIeee = make_table(0xEDB88320u);
constexpr Table kCastagnoli = make_table(0x82F63B78u);

uint32_t crc(const Table& table, uint32_t before, const uint8_t* bytes, size_t n) {
  uint32_t value = ~before;
  for (size_t i = 0; i < n; ++i) value = (value >> 8) ^ table[(value ^ bytes[i]) & 0xFFu];
  return ~value;
}

}  // namespace

extern "C" uint32_t berm_crc32(const uint8_t* bytes, size_t n) { return crc(kIeee, 0, bytes, n); }
extern "C" uint32_t berm_crc32_continue(uint32_t before, const uint8_t* bytes, size_t n) { return crc(kIeee, before, bytes, n); }
extern "C" uint32_t berm_crc32c(const uint8_t* bytes, size_t n) { return crc(kCastagnoli, 0, bytes, n); }

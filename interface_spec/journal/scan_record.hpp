// A scan of a cycle's record. Any bytes may come.
#pragma once

#include "journal/bytes.hpp"
#include "scan/scan_packet.h"

namespace berm::record {

// False when the bytes end before it, or a field is outside what the kernel's decoder lets through (SCAN.md).
bool take_scan(ByteReader& from, berm_scan_packet& to);

// Parts of a record are filled up to 8 bytes.
constexpr std::size_t up8(std::size_t bytes) { return (bytes + 7U) / 8U * 8U; }

}  // namespace berm::record

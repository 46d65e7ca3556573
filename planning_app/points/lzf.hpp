// Decoder of LibLZF's format, which PCD's binary_compressed uses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace berm::app {

// The decompressed bytes when they are exactly size many; none when the input is malformed, ends early or yields another number of bytes.
// Memory grows with what is decoded: at most 88 bytes for each byte of input.
std::optional<std::string> lzf_decompress(std::string_view packed, std::size_t size);

}  // namespace berm::app

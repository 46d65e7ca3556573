#include "points/lzf.hpp"

namespace berm::app {

std::optional<std::string> lzf_decompress(std::string_view packed, std::size_t size) {
  std::string out;
  std::size_t at = 0;
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(packed[i])); };
  while (at < packed.size()) {
    const std::size_t control = byte(at++);
    if (control < 32) {  // a run of control + 1 bytes as they are
      const std::size_t run = control + 1;
      if (run > packed.size() - at || run > size - out.size()) return std::nullopt;
      out.append(packed.substr(at, run));
      at += run;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at == packed.size()) return std::nullopt;
      length += byte(at++);
    }
    length += 2;
    if (at == packed.size()) return std::nullopt;
    const std::size_t back = ((control & 31) << 8 | byte(at++)) + 1;
    if (back > out.size() || length > size - out.size()) return std::nullopt;
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);  // may overlap what it writes
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace berm::app

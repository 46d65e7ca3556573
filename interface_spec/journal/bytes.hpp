// Little-endian bytes, appended and read; reading never passes the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace berm::record {

class ByteWriter {
 public:
  void u8(std::uint8_t v) { bytes_.push_back(v); }
  void u16(std::uint16_t v) { little(v, 2); }
  void u32(std::uint32_t v) { little(v, 4); }
  void u64(std::uint64_t v) { little(v, 8); }
  void raw(const void* from, std::size_t n) {
    const auto* p = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), p, p + n);
  }
  void text(const std::string& s) {
    u32(static_cast<std::uint32_t>(s.size()));
    raw(s.data(), s.size());
  }
  std::size_t size() const { return bytes_.size(); }
  const std::uint8_t* data() const { return bytes_.data(); }
  void clear() { bytes_.clear(); }

 private:
  void little(std::uint64_t v, int n) {
    for (int i = 0; i < n; ++i) bytes_.push_back(static_cast<std::uint8_t>(v >> (8 * i)));
  }
  std::vector<std::uint8_t> bytes_;
};

// good() turns false for ever with the first read beyond the end; such a read gives zero, or nothing.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}
  std::uint8_t u8() { return static_cast<std::uint8_t>(little(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little(4)); }
  std::uint64_t u64() { return little(8); }
  const std::uint8_t* raw(std::uint64_t n) {
    if (n > left_) {
      good_ = false;
      left_ = 0;
      return nullptr;
    }
    const std::uint8_t* from = at_;
    at_ += n;
    left_ -= static_cast<std::size_t>(n);
    return from;
  }
  std::string text() {
    const std::uint32_t n = u32();
    const std::uint8_t* from = raw(n);
    return from == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(from), n);
  }
  template <class T>
  bool copy(T& to) {
    const std::uint8_t* from = raw(sizeof to);
    if (from != nullptr) std::memcpy(&to, from, sizeof to);
    return from != nullptr;
  }
  std::size_t left() const { return left_; }
  bool good() const { return good_; }

 private:
  std::uint64_t little(std::size_t n) {
    const std::uint8_t* from = raw(n);
    std::uint64_t v = 0;
    for (std::size_t i = 0; from != nullptr && i < n; ++i) v |= static_cast<std::uint64_t>(from[i]) << (8 * i);
    return v;
  }
  const std::uint8_t* at_;
  std::size_t left_;
  bool good_ = true;
};

}  // namespace berm::record

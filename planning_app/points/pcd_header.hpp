// The header of a PCD file: which fields a point has, how many points are claimed, how the data lie.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace berm::app {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  char type = 'F';            // F, I or U
  std::size_t size = 4;       // bytes of one element
  std::size_t count = 1;      // elements
  std::size_t offset = 0;     // bytes from the beginning of a binary point
  std::size_t first_word = 0;  // words from the beginning of an ascii point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t point_bytes = 0;
  std::size_t point_words = 0;
  std::uint64_t points = 0;  // as claimed; nothing may be allocated by it
  std::array<double, 3> viewpoint{0, 0, 0};
  PcdData data = PcdData::kAscii;
  std::size_t data_begin = 0;  // bytes from the file's beginning

  const PcdField* find(std::string_view name) const;
};

// Throws PointFileError that names the file, the header line and the limit.
PcdHeader parse_pcd_header(std::string_view bytes, const std::string& name);

}  // namespace berm::app

#include "points/pcd.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "points/file_bytes.hpp"
#include "points/lzf.hpp"
#include "points/pcd_header.hpp"

namespace berm::app {
namespace {

template <typename T>
T load(const char* from) {  // the format is little-endian, as every machine that Berm is built for
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

double element(const char* from, char type, std::size_t size) {
  if (type == 'F') return size == 8 ? load<double>(from) : static_cast<double>(load<float>(from));
  if (type == 'U') {
    switch (size) {
      case 1: return load<std::uint8_t>(from);
      case 2: return load<std::uint16_t>(from);
      case 4: return load<std::uint32_t>(from);
      default: return static_cast<double>(load<std::uint64_t>(from));
    }
  }
  switch (size) {
    case 1: return load<std::int8_t>(from);
    case 2: return load<std::int16_t>(from);
    case 4: return load<std::int32_t>(from);
    default: return static_cast<double>(load<std::int64_t>(from));
  }
}

// Takes the five values of point after point and refuses what the file may not hold.
class Intake {
public:
  Intake(PointCloud& cloud) : cloud_(cloud) {}

  void add(const std::array<double, 5>& value) {
    static constexpr const char* kName[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs(value[i]) <= kCoordinateLimit)) fail(kName[i], fmt::format("is not finite or beyond {:g} m", kCoordinateLimit));
    if (!(value[3] >= 0.0 && value[3] <= std::numeric_limits<std::uint32_t>::max()) || value[3] != std::floor(value[3]))
      fail("scanline", "is no whole number from 0 to 4294967295");
    if (!(std::abs(value[4]) <= kTimeLimit)) fail("time", fmt::format("is not finite or beyond {:g} s", kTimeLimit));
    const auto scanline = static_cast<std::uint32_t>(value[3]);
    if (!cloud_.points.empty()) {
      const ScanPoint& last = cloud_.points.back();
      if (scanline < last.scanline) fail("scanline", "runs backwards");
      if (scanline == last.scanline && value[4] < last.time_s) fail("time", "runs backwards within a scanline");
    }
    cloud_.points.push_back({static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2]), scanline, value[4]});
  }

  [[noreturn]] void fail(const std::string& field, const std::string& why) const {
    throw PointFileError(fmt::format("{}: {}: {} (point {})", cloud_.file, field, why, cloud_.points.size()));
  }

private:
  PointCloud& cloud_;
};

using Wanted = std::array<const PcdField*, 5>;

void read_ascii(std::string_view data, const PcdHeader& header, const Wanted& wanted, Intake& intake) {
  std::size_t at = 0;
  std::vector<std::string_view> words(header.point_words);
  const auto next_word = [&]() -> std::string_view {
    at = data.find_first_not_of(" \t\r\n", at);
    if (at == std::string_view::npos) return {};
    const std::size_t end = std::min(data.find_first_of(" \t\r\n", at), data.size());
    const std::string_view word = data.substr(at, end - at);
    at = end;
    return word;
  };
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (auto& word : words)
      if ((word = next_word()).empty()) intake.fail("POINTS", fmt::format("claims {} points and the data end before", header.points));
    std::array<double, 5> value{};
    for (std::size_t k = 0; k < 5; ++k) {
      if (wanted[k] == nullptr) continue;
      const std::string_view word = words[wanted[k]->first_word];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value[k]);
      if (error != std::errc{} || end != word.data() + word.size()) intake.fail(wanted[k]->name, "is no number");
    }
    intake.add(value);
  }
  if (!next_word().empty()) intake.fail("POINTS", fmt::format("claims {} points and the data go on", header.points));
}

// field_major: of binary_compressed, all values of a field before the next field's.
void read_binary(std::string_view data, const PcdHeader& header, const Wanted& wanted, bool field_major, Intake& intake) {
  if (data.size() / header.point_bytes < header.points)
    intake.fail("POINTS", fmt::format("claims {} points of {} bytes and {} bytes are there", header.points, header.point_bytes, data.size()));
  if (data.size() != header.points * header.point_bytes) intake.fail("POINTS", fmt::format("claims {} points and the data go on", header.points));
  for (std::uint64_t i = 0; i < header.points; ++i) {
    std::array<double, 5> value{};
    for (std::size_t k = 0; k < 5; ++k) {
      const PcdField* field = wanted[k];
      if (field == nullptr) continue;
      const std::size_t at = field_major ? field->offset * header.points + i * field->size * field->count : i * header.point_bytes + field->offset;
      value[k] = element(data.data() + at, field->type, field->size);
    }
    intake.add(value);
  }
}

}  // namespace

PointCloud parse_pcd(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  cloud.file = name;
  cloud.format = "pcd";
  const PcdHeader header = parse_pcd_header(bytes, name);
  cloud.viewpoint = header.viewpoint;
  const Wanted wanted{header.find("x"), header.find("y"), header.find("z"), header.find("scanline"), header.find("time")};
  cloud.scanlines = wanted[3] != nullptr;
  cloud.times = wanted[4] != nullptr;
  const std::string_view data = bytes.substr(header.data_begin);
  Intake intake(cloud);
  if (header.data == PcdData::kAscii) {
    read_ascii(data, header, wanted, intake);
  } else if (header.data == PcdData::kBinary) {
    read_binary(data, header, wanted, false, intake);
  } else {
    if (data.size() < 8) intake.fail("DATA", "ends before the two sizes of binary_compressed");
    const std::size_t packed = load<std::uint32_t>(data.data());
    const std::size_t whole = load<std::uint32_t>(data.data() + 4);
    if (packed > data.size() - 8) intake.fail("DATA", fmt::format("claims {} compressed bytes and {} are there", packed, data.size() - 8));
    if (packed < data.size() - 8) intake.fail("DATA", fmt::format("claims {} compressed bytes and the data go on", packed));
    if (whole != header.points * header.point_bytes)
      intake.fail("DATA", fmt::format("claims {} bytes for {} points of {} bytes", whole, header.points, header.point_bytes));
    const auto unpacked = lzf_decompress(data.substr(8, packed), whole);
    if (!unpacked) intake.fail("DATA", fmt::format("the compressed bytes do not yield {} bytes", whole));
    read_binary(*unpacked, header, wanted, true, intake);
  }
  return cloud;
}

PointCloud read_pcd_cloud(const std::string& path) { return parse_pcd(read_file_bytes(path), path); }

std::vector<ScanPoint> read_pcd(const std::string& path) { return read_pcd_cloud(path).points; }

void write_pcd(const std::string& path, const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint) {
  std::string out = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z scanline time\nSIZE 4 4 4 4 8\nTYPE F F F U F\nCOUNT 1 1 1 1 1\n"
      "WIDTH {}\nHEIGHT 1\nVIEWPOINT {} {} {} 1 0 0 0\nPOINTS {}\nDATA binary\n",
      points.size(), viewpoint[0], viewpoint[1], viewpoint[2], points.size());
  const auto put = [&out](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  out.reserve(out.size() + points.size() * 24);
  for (const ScanPoint& p : points) {
    put(p.x);
    put(p.y);
    put(p.z);
    put(p.scanline);
    put(p.time_s);
  }
  write_file_bytes(path, out);
}

}  // namespace berm::app

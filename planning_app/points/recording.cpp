#include "points/recording.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <system_error>

#include "points/file_bytes.hpp"
#include "points/lms111.hpp"
#include "points/pcap.hpp"
#include "points/pcd.hpp"

namespace berm::app {

PointCloud parse_recording(std::string_view bytes, const std::string& name) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) throw PointFileError(fmt::format("{}: size: the file is empty", name));
  if (bytes[begin] == '[' || bytes[begin] == '{') return parse_lms(bytes, name);
  const std::string_view head = bytes.substr(begin, 400);
  if (head.substr(0, 7) == "VERSION" || head.substr(0, 6) == "FIELDS" || (head[0] == '#' && head.find("PCD") != std::string_view::npos)) return parse_pcd(bytes, name);
  return parse_pcap(bytes, name);
}

PointCloud read_recording(const std::string& path) try {
  return parse_recording(read_file_bytes(path), path);
} catch (const std::bad_alloc&) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);  // a pipe has none
  throw PointFileError(fmt::format("{}: memory: too little to read {}", path, none ? "it" : fmt::format("its {} bytes and their points", size)));
}

}  // namespace berm::app

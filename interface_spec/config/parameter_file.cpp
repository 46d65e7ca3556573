// The parameter block as a file.
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "config/compile_parameters.hpp"
#include "config/strict_table.hpp"
#include "config/whole_file.hpp"
#include "scan/scan_packet.h"

namespace berm::config {

std::int32_t parameters_crc(const berm_parameters& block) {
  std::array<std::uint8_t, offsetof(berm_parameters, crc32)> bytes{};
  std::memcpy(bytes.data(), &block, bytes.size());
  return static_cast<std::int32_t>(berm_crc32(bytes.data(), bytes.size()));
}

void save_parameters(const berm_parameters& block, const std::string& path) {
  try {
    write_whole_file(path, {reinterpret_cast<const char*>(&block), sizeof block}, true);
  } catch (const std::runtime_error& error) {
    throw ConfigError(error.what());
  }
}

berm_parameters parse_parameters(std::string_view bytes, const std::string& name) {
  berm_parameters block{};
  if (bytes.size() != sizeof block) throw ConfigError(fmt::format("{}: size: a parameter block has exactly {} bytes", name, sizeof block));
  std::memcpy(&block, bytes.data(), sizeof block);
  if (block.magic != BERM_PARAMETERS_MAGIC) throw ConfigError(fmt::format("{}: magic: no parameter block", name));
  if (block.version != BERM_PARAMETERS_VERSION) throw ConfigError(fmt::format("{}: version: {}, {} is known", name, block.version, BERM_PARAMETERS_VERSION));
  if (block.crc32 != parameters_crc(block)) throw ConfigError(fmt::format("{}: crc32: wrong", name));
  return block;
}

berm_parameters load_parameters(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  std::array<char, sizeof(berm_parameters) + 1> bytes{};  // one more than a block has, so that a longer file is noticed
  file.read(bytes.data(), bytes.size());
  return parse_parameters({bytes.data(), static_cast<std::size_t>(file.gcount())}, path);
}

}  // namespace berm::config

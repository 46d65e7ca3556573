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

berm_parameters load_parameters(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  berm_parameters block{};
  file.read(reinterpret_cast<char*>(&block), sizeof block);
  if (file.gcount() != static_cast<std::streamsize>(sizeof block) || file.peek() != std::ifstream::traits_type::eof())
    throw ConfigError(fmt::format("{}: size: a parameter block has exactly {} bytes", path, sizeof block));
  if (block.magic != BERM_PARAMETERS_MAGIC) throw ConfigError(fmt::format("{}: magic: no parameter block", path));
  if (block.version != BERM_PARAMETERS_VERSION) throw ConfigError(fmt::format("{}: version: {}, {} is known", path, block.version, BERM_PARAMETERS_VERSION));
  if (block.crc32 != parameters_crc(block)) throw ConfigError(fmt::format("{}: crc32: wrong", path));
  return block;
}

}  // namespace berm::config

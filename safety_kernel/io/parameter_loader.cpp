#include "io/parameter_loader.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/crc32.h"
#include "core/parameter_check.h"

namespace berm::kernel {

namespace {

constexpr std::size_t kBytes = sizeof(berm_parameters);
static_assert(offsetof(berm_parameters, crc32) == kBytes - sizeof(std::int32_t), "the CRC is the last field");

// One byte more than a block has is asked for, so that a longer file is noticed.
bool read_bytes(const std::string& path, std::uint8_t (&bytes)[kBytes + 1], std::size_t& size, std::string& error) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  if (file == nullptr) {
    error = path + ": " + std::strerror(errno);
    return false;
  }
  size = std::fread(bytes, 1, sizeof bytes, file.get());
  if (std::ferror(file.get()) == 0) return true;
  error = path + ": cannot be read";
  return false;
}

}  // namespace

bool load_parameters(const std::string& path, berm_parameters& parameters, std::string& error) {
  std::uint8_t bytes[kBytes + 1];
  std::size_t size = 0;
  return read_bytes(path, bytes, size, error) && parse_parameters(path, bytes, size, parameters, error);
}

bool parse_parameters(const std::string& path, const std::uint8_t* bytes, std::size_t size, berm_parameters& parameters, std::string& error) {
  if (size != kBytes) {
    error = path + ": a parameter block has " + std::to_string(kBytes) + " bytes, this file has " + (size > kBytes ? "more" : std::to_string(size));
    return false;
  }
  berm_parameters block;
  std::memcpy(&block, bytes, kBytes);
  if (block.magic != BERM_PARAMETERS_MAGIC) {
    error = path + ": not a parameter block: magic";
    return false;
  }
  if (block.version != BERM_PARAMETERS_VERSION) {
    error = path + ": version " + std::to_string(block.version) + ", this kernel takes " + std::to_string(BERM_PARAMETERS_VERSION);
    return false;
  }
  if (static_cast<std::uint32_t>(block.crc32) != sk_crc32(bytes, static_cast<std::int32_t>(offsetof(berm_parameters, crc32)))) {
    error = path + ": the CRC does not match: damaged or changed by hand";
    return false;
  }
  const std::int32_t rule = sk_parameters_check(&block);
  if (rule != 0) {
    error = path + ": rule " + std::to_string(rule) + ": " + parameter_rule_text(rule);
    return false;
  }
  parameters = block;
  return true;
}

}  // namespace berm::kernel

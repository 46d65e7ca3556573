// Machine and site into the kernel's parameter block. Every rounding to integers goes to the safe side.
#pragma once

#include <string>
#include <string_view>

#include "config/machine_file.hpp"
#include "config/parameter_block.h"
#include "config/site_file.hpp"

namespace berm::config {

// The block with its CRC.
berm_parameters compile_parameters(const MachineFile& machine, const SiteFile& site);
// The CRC-32 that belongs into the block.
std::int32_t parameters_crc(const berm_parameters& block);
// Writes the block, whole or not at all. Throws ConfigError naming the path.
void save_parameters(const berm_parameters& block, const std::string& path);
// Reads a block and checks size, magic, version and CRC. Throws ConfigError naming the path and what is wrong.
berm_parameters load_parameters(const std::string& path);
// The same of bytes that are at hand; name stands in the message.
berm_parameters parse_parameters(std::string_view bytes, const std::string& name);
// For people: one field a line.
std::string describe(const berm_parameters& block);

}  // namespace berm::config

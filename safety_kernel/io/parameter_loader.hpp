// Loads the parameter block: exact size, CRC, then every rule of the core. Nothing is used of a block that fails in one point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "config/parameter_block.h"

namespace berm::kernel {

// False with one line "FILE: what is wrong" in error; parameters is then unchanged.
bool load_parameters(const std::string& path, berm_parameters& parameters, std::string& error);

// The same of a block in memory; name stands for FILE.
bool parse_parameters(const std::string& name, const std::uint8_t* bytes, std::size_t size, berm_parameters& parameters, std::string& error);

// What the rule with this ordinal of sk_parameters_check demands.
const char* parameter_rule_text(std::int32_t rule);

}  // namespace berm::kernel

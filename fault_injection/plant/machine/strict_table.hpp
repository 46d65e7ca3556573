// The strict reading of TOML files, under the plant's own names.
#pragma once

#include "config/strict_table.hpp"

namespace berm::plant {

using config::ConfigError;
using config::radians;
using config::StrictTable;

}  // namespace berm::plant

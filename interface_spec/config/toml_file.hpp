// TOML files into toml11's values: for StrictTable, and for who reads a few keys of a file that another program checks.
#pragma once

#include <string>
#include <toml.hpp>

namespace berm::config {

// Throws ConfigError, one line that names the file: unreadable, not TOML, or nested more than 100 deep, which toml11's recursion might not survive.
toml::value parse_toml_file(const std::string& file);

}  // namespace berm::config

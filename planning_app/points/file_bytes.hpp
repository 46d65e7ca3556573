// Whole files in and out of memory.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace berm::app {

constexpr std::size_t kPointFileBytes = std::size_t{1} << 30;  // the largest recording that the readers take

// The file's bytes. Memory grows with what is read, never with what is claimed. Throws PointFileError when it cannot be read or is larger than limit.
std::string read_file_bytes(const std::string& path, std::size_t limit = kPointFileBytes);

// config::write_whole_file. Throws PointFileError.
void write_file_bytes(const std::string& path, std::string_view bytes);

}  // namespace berm::app

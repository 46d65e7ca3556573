// Output files that are whole or not there.
#pragma once

#include <string>
#include <string_view>

namespace berm::config {

// Writes beside the file first, then renames: path holds the old bytes or all the new ones, after a power cut too where durable.
// A link stays, and the file that it points to is replaced. What is no regular file (a device, a pipe) is written to where it stands, never replaced.
// Throws std::runtime_error: the path, then why.
void write_whole_file(const std::string& path, std::string_view bytes, bool durable = false);

}  // namespace berm::config

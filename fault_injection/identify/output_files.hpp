// What is checked of the files that an identification writes.
#pragma once

#include <string>

namespace berm::identify {

// Known before hours of tests, not after. Nothing for an empty name. Throws std::runtime_error naming the file.
void check_writable(const std::string& file);
// A new machine file must be one that every reader takes. Throws std::runtime_error.
void check_readable(const std::string& machine_text);

}  // namespace berm::identify

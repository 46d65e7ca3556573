// Where measured values are from, as a machine file says it.
#pragma once

#include <string>

namespace berm::identify {

// The command and what it found, as long as a machine file may have it: of a command that is longer the last words are left out, and dots say so.
std::string provenance_text(const std::string& command, const std::string& found);

}  // namespace berm::identify

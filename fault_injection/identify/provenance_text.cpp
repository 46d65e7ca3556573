#include "identify/provenance_text.hpp"

#include "config/strict_table.hpp"

namespace berm::identify {

std::string provenance_text(const std::string& command, const std::string& found) {
  const std::string before = "measured in simulation: ", after = "; " + found, left_out = " ...";
  const std::size_t room = config::kLongestText - before.size() - after.size();
  if (command.size() <= room) return before + command + after;
  return before + command.substr(0, command.rfind(' ', room - left_out.size())) + left_out + after;
}

}  // namespace berm::identify

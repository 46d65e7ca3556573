// The default machine and site files, edited.
#pragma once

#include <string>
#include <vector>

#include "scratch.hpp"

namespace berm::config::test {

std::string machine_path();
std::string site_path();
std::string read_text(const std::string& path);
// Text with the first occurrence of from replaced; throws when there is none, so that no edit is silently nothing.
std::string replaced(std::string text, const std::string& from, const std::string& to);

using berm::test::Scratch;

struct BadEdit {
  const char* name;
  const char* from;
  std::string to;
  const char* field;   // the line names it
  const char* reason;  // and says this
};

const std::vector<BadEdit>& bad_machine_edits();
const std::vector<BadEdit>& bad_site_edits();

}  // namespace berm::config::test

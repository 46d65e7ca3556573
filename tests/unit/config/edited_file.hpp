// The default machine and site files, edited, in a folder of their own that goes with the test.
#pragma once

#include <string>
#include <vector>

namespace berm::config::test {

std::string machine_path();
std::string site_path();
std::string read_text(const std::string& path);
// Text with the first occurrence of from replaced; throws when there is none, so that no edit is silently nothing.
std::string replaced(std::string text, const std::string& from, const std::string& to);

class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const;
  std::vector<std::string> names() const;  // what is in the folder, sorted

 private:
  std::string folder_;
};

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

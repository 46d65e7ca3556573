// The folder that a run writes to, for it alone: two runs in one would mix their files.
#pragma once

#include <string>

namespace berm::run {

// Makes the folder where there is none, and holds a lock on it, of which a killed run leaves nothing.
class OutFolder {
 public:
  explicit OutFolder(const std::string& path);  // throws std::runtime_error naming it: it cannot be made, or another run is at work in it
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace berm::run

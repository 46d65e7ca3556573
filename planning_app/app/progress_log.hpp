// Progress as JSON lines on a file descriptor, by write(2) alone: nothing else is allowed in the sandbox.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace berm::app {

class ProgressLog {
public:
  explicit ProgressLog(int fd) : fd_(fd) {}
  // One line; {"event": name, ...fields}. A reader that is gone is not an error of the app.
  void event(const std::string& name, nlohmann::ordered_json fields = nlohmann::ordered_json::object()) const;

private:
  int fd_;
};

}  // namespace berm::app

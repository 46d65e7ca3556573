// The app's events, as a reader of its standard output has them.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace berm::app_bench {

class Events {
public:
  Events() : fd_(memfd_create("events", 0)) {
    if (fd_ < 0) throw std::runtime_error("memfd_create");
  }
  ~Events() { close(fd_); }
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;

  int fd() const { return fd_; }
  std::vector<nlohmann::json> named(const std::string& name) const {
    std::string text(static_cast<std::size_t>(lseek(fd_, 0, SEEK_END)), '\0');
    if (pread(fd_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) throw std::runtime_error("the events cannot be read");
    std::istringstream lines(text);
    std::vector<nlohmann::json> out;
    for (std::string line; std::getline(lines, line);)
      if (auto event = nlohmann::json::parse(line); event.at("event") == name) out.push_back(std::move(event));
    return out;
  }

private:
  int fd_;
};

}  // namespace berm::app_bench

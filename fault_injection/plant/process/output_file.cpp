#include "plant/process/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace berm::plant {

OutputFile::OutputFile(const std::string& path) : path_(path), file_(std::fopen((path + ".part").c_str(), "wb")) {
  if (file_ == nullptr) throw std::runtime_error(fmt::format("{}: {}", path, std::strerror(errno)));
  std::setvbuf(file_, nullptr, _IOFBF, 1 << 20);
}

OutputFile::~OutputFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove((path_ + ".part").c_str());
}

void OutputFile::write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) throw std::runtime_error(fmt::format("{}: {}", path_, std::strerror(errno)));
}

void OutputFile::finish() {
  std::FILE* file = file_;
  file_ = nullptr;
  const bool closed = std::fclose(file) == 0;
  if (!closed || std::rename((path_ + ".part").c_str(), path_.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    std::remove((path_ + ".part").c_str());
    throw std::runtime_error(fmt::format("{}: {}", path_, reason));
  }
}

}  // namespace berm::plant

// A file that appears under its name only when it is complete.
#pragma once

#include <cstdio>
#include <string>

namespace berm::plant {

class OutputFile {
 public:
  explicit OutputFile(const std::string& path);  // throws std::runtime_error; writes to path + ".part"
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();                                 // not finished: the part is removed

  void write(const std::string& text);
  void finish();                                 // throws std::runtime_error when anything could not be written

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace berm::plant

// SIGINT and SIGTERM as an error like any other, so that the plant is ended and its folder removed.
#pragma once

namespace berm::identify {

class Interruption {
 public:
  Interruption();  // from now on both signals wait to be asked for
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();
  void check() const;  // throws std::runtime_error when one has come

 private:
  int fd_ = -1;
};

}  // namespace berm::identify

// One coordinate along a line in whole steps: start + change * k / steps, towards the start as integers divide, for k = 1, 2, ...; without a division for each.
#pragma once

#include <cstdint>

namespace berm::kernel {

class Along {
 public:
  Along(std::int64_t start, std::int64_t change, std::int64_t steps)
      : value_(start), each_(steps > 0 ? change / steps : 0), rest_each_(steps > 0 ? change % steps : 0), steps_(steps), sign_(change < 0 ? -1 : 1) {}
  std::int32_t next() {
    value_ += each_;
    rest_ += rest_each_;
    if (sign_ * rest_ >= steps_) {
      rest_ -= sign_ * steps_;
      value_ += sign_;
    }
    return static_cast<std::int32_t>(value_);
  }

 private:
  std::int64_t value_, each_, rest_each_, steps_, sign_, rest_ = 0;
};

}  // namespace berm::kernel

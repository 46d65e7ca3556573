// A sensor's own clock, microseconds since the hour, on the kernel's.
//
// A packet comes some time after it was finished, never before: of many the least delay is nearest to none. So the difference of the clocks is the
// least that was seen, let grow a little with time, since the two do not run alike.
#pragma once

#include <algorithm>
#include <cstdint>

namespace berm::kernel {

class SensorClock {
 public:
  static constexpr std::uint32_t kHourUs = 3600000000U;
  static constexpr std::int64_t kDriftDivisor = 10000;  // the clocks differ by less than a ten thousandth

  // From one of its readings to a later one.
  static std::uint32_t ahead_us(std::uint32_t from_us, std::uint32_t to_us) {
    return to_us >= from_us ? to_us - from_us : to_us + (kHourUs - from_us);
  }

  // The first packet, or the first after a silence; it arrived at now_us.
  void begin(std::uint32_t clock_us, std::int64_t now_us) {
    clock_us_ = clock_us;
    time_us_ = now_us;
  }
  // The next, later by its clock.
  void advance(std::uint32_t clock_us, std::int64_t now_us) {
    const std::int64_t ahead = ahead_us(clock_us_, clock_us);
    clock_us_ = clock_us;
    time_us_ = std::min(time_us_ + ahead + ahead / kDriftDivisor, now_us);
  }

  std::uint32_t clock_us() const { return clock_us_; }  // newest reading
  std::int64_t time_us() const { return time_us_; }     // when that packet was finished, on the kernel's clock

 private:
  std::uint32_t clock_us_ = 0;
  std::int64_t time_us_ = 0;
};

}  // namespace berm::kernel

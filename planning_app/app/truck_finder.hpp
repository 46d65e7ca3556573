// Who tells a truck from a sweep, while it goes on: the recogniser in a thread of its own, or a test.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "recognition/truck_recogniser.hpp"

namespace berm::app {

class TruckFinder {
public:
  virtual ~TruckFinder() = default;
  // A sweep begins; viewpoint: of the scanner, base frame. What was told of an earlier one is dropped.
  virtual void begin(const std::array<double, 3>& viewpoint) = 0;
  // Its next scanline in measuring order, base frame; turned: by how much the machine had swung by then since the sweep began, rad; cycle: now. A scanline
  // may stand for a question, when it may have shown the end of something.
  virtual void take(std::vector<ScanPoint> scanline, double turned, std::uint64_t cycle) = 0;
  // It has ended: the last question.
  virtual void end(std::uint64_t cycle) = 0;
  // Once a sweep: the answer that stands, a truck while the sweep still goes on, or whatever the sweep's end brought.
  virtual std::optional<RecognisedTruck> answer(std::uint64_t cycle) = 0;
};

}  // namespace berm::app

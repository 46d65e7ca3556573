// Who tells a truck from a sweep: the recogniser in a thread of its own, or a test.
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
  // points: one sweep, base frame; viewpoint: of the scanner in the middle of it. A question that is still open is dropped.
  virtual void ask(std::vector<ScanPoint> points, const std::array<double, 3>& viewpoint, std::uint64_t cycle) = 0;
  // Once, to the newest question.
  virtual std::optional<RecognisedTruck> answer(std::uint64_t cycle) = 0;
};

}  // namespace berm::app

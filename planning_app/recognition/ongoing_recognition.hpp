// Truck recognition while the sweep goes on: when to ask, and whether the answer stands. The scanner goes over the truck from one end to the other; what
// it has not passed yet an answer can only guess, and says so by its covariance and by the evidence of its cab. An early refusal is never final.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "recognition/arriving_sweep.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::app {

class OngoingRecognition {
public:
  // viewpoint as ArrivingSweep's; ranges must outlive it.
  OngoingRecognition(const std::array<double, 3>& viewpoint, const TruckRangeSet& ranges) : ranges_(ranges), sweep_(viewpoint) {}

  // The points of the next scanline, in measuring order; turned as ArrivingSweep's. True: something may have come to its end, and asking is worth its time.
  bool take(std::span<const ScanPoint> scanline, double turned = 0.0);

  // recognise_truck over the scanlines so far, bit for bit where none was told to have turned. Asked again without a scanline in between it is not searched for again.
  const RecognisedTruck& ask();

  // Whether more scanlines would hardly change the last answer: a truck was found, with evidence that leaves no doubt, and while the scanner turned on
  // answers have stayed the same, the bed's corners and the evidence of the cab, for
  // - a degree, when it has passed the bed, of which both ends are known;
  // - three degrees, when both ends are known well, or when it has passed the bed and the place of the cab, whatever it has seen there.
  // The cab was seen well enough to tell the front, for which less will do where its place was passed: an end before which the place was seen empty is
  // never the front while that of the other was not seen. At the sweep's end every answer is the last.
  bool stands() const { return stands_; }

private:
  bool passed(const RecognisedTruck& truck, double before_front) const;  // the bed, and metres before it, by the newest scanline
  bool hardly_changes(const RecognisedTruck& truck) const;

  const TruckRangeSet& ranges_;
  ArrivingSweep sweep_;
  std::optional<RecognisedTruck> answer_;
  std::size_t asked_ = 0;          // with so many fans
  double asked_turn_ = 0.0;        // and so far turned
  bool stands_ = false;
  RecognisedTruck settled_;        // the first of the answers that were the same until now
  double settled_turn_ = 0.0;
};

}  // namespace berm::app

// Which of several verified beds is taken.
#include "recognition/bed_choice.hpp"

#include <gtest/gtest.h>

#include "recognition/cab_profile.hpp"

namespace berm::app {
namespace {

TruckRangeSet chosen_ranges() { return read_truck_ranges(BERM_TRUCK_RANGES); }

VerifiedBed bed_of(double score, double length = 5.0) {
  VerifiedBed v;
  v.interpretation.evidence.score = score;
  v.interpretation.pose.length = length, v.interpretation.pose.width = 2.4;
  v.interpretation.cab_end = 1;
  v.fit.pose = v.interpretation.pose;
  return v;
}

TEST(BedChoice, WhatClosesABedCountsAsOne) {
  VerifiedBed v = bed_of(200.0);
  v.interpretation.evidence.end_face = 50.0, v.interpretation.cab_to_front = 40.0;
  EXPECT_EQ(decides(v), 150.0 + kCabEnough);
  v.interpretation.cab_to_front = 400.0;
  EXPECT_EQ(decides(v), 150.0 + kCabEnough);
  v.interpretation.cab_to_front = 5.0;
  EXPECT_EQ(decides(v), 205.0);
  v.agreed = 220.0;
  EXPECT_EQ(decides(v), 225.0) << "that moves of its walls came to";
  v.agreed = 190.0;
  EXPECT_EQ(decides(v), 205.0) << "or the fit";
}

// The front wall in a cab agrees with all of the cab's front.
TEST(BedChoice, ABedWithItsFrontInTheCabIsNotTaken) {
  VerifiedBed in_cab = bed_of(260.0), bed = bed_of(200.0);
  in_cab.interpretation.evidence.end_face = 150.0;
  bed.interpretation.cab_to_front = 90.0;
  EXPECT_EQ(choose({in_cab, bed}, chosen_ranges()).interpretation.evidence.score, 200.0);
  bed.refusal = "refused";
  EXPECT_EQ(choose({in_cab, bed}, chosen_ranges()).interpretation.evidence.score, 260.0);
}

TEST(BedChoice, OfAContainersWallsABedNeedsACabThatTheseDoNotExplain) {
  VerifiedBed bed = bed_of(100.0), whole = bed_of(150.0, 9.0);
  whole.refusal = "no class";
  bed.interpretation.cab = 10.0, bed.interpretation.cab_seen = 80.0;
  EXPECT_FALSE(choose({bed, whole}, chosen_ranges()).refusal.empty());
  bed.interpretation.cab = 60.0;
  EXPECT_TRUE(choose({bed, whole}, chosen_ranges()).refusal.empty());
  whole = bed_of(150.0, 6.0);
  whole.refusal = "no class";
  bed.interpretation.cab = 10.0;
  EXPECT_TRUE(choose({bed, whole}, chosen_ranges()).refusal.empty()) << "as long as a truck's";
  bed.of_refused = true;
  EXPECT_FALSE(choose({bed, whole}, chosen_ranges()).refusal.empty()) << "cut from what was refused";
}

TEST(BedChoice, ABedAndItsCabTakenForOneAreNoContainer) {
  VerifiedBed bed = bed_of(100.0), longer = bed_of(400.0, 7.0);
  longer.refusal = "no class";
  longer.interpretation.pose.middle.x() = 1.0;
  bed.interpretation.cab = bed.interpretation.cab_seen = 40.0;
  EXPECT_TRUE(choose({bed, longer}, chosen_ranges()).refusal.empty());
  bed.interpretation.cab = 39.0;
  EXPECT_FALSE(choose({bed, longer}, chosen_ranges()).refusal.empty());
}

TEST(BedChoice, TellsAFitThatWentBack) {
  const BedPose from = bed_of(0.0).fit.pose;
  BedPose to = from;
  to.middle.x() += 0.03, to.length += 0.06;
  EXPECT_TRUE(comes_back(to, from));
  to.length += 0.02;
  EXPECT_FALSE(comes_back(to, from));
  to = from;
  to.middle.x() += 0.11;
  EXPECT_FALSE(comes_back(to, from));
}

}  // namespace
}  // namespace berm::app

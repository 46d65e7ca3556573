// What the spotter says of a truck, and what may be concluded from his silence.
#include <gtest/gtest.h>

#include "app/truck_presence.hpp"

namespace {

using berm::app::Observation;
using berm::app::TruckPresence;

// Cycles of 10 ms, each with what the spotter says.
void pass(TruckPresence& presence, double& t, double seconds, bool parked, bool leaves) {
  for (const double end = t + seconds; t < end - 1e-6; t += 0.01) {
    Observation o;
    o.time_s = t;
    o.truck_parked = parked;
    o.truck_leaves = leaves;
    presence.step(o);
  }
}

TEST(TruckPresence, ATruckThatLeavesIsGoneAtOnceAndForGood) {
  TruckPresence presence;
  double t = 5.0;
  presence.begin();
  pass(presence, t, 10.0, true, false);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::no);
  pass(presence, t, 0.01, false, true);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::left);
  pass(presence, t, 30.0, true, false);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::left) << "the next truck is not the one that was meant";
  presence.begin();
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::no);
}

TEST(TruckPresence, AShortSilenceIsNoDeparture) {
  TruckPresence presence;
  double t = 0.0;
  presence.begin();
  for (int k = 0; k < 10; ++k) {
    pass(presence, t, 1.5, false, false);
    pass(presence, t, 0.1, true, false);
  }
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::no);
}

TEST(TruckPresence, ALongSilenceIsOneThatWasNotSeen) {
  TruckPresence presence;
  double t = 0.0;
  presence.begin();
  pass(presence, t, 1.9, false, false);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::no);
  pass(presence, t, 0.2, false, false);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::unadmitted);
  pass(presence, t, 5.0, true, false);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::unadmitted);
  pass(presence, t, 0.01, false, true);
  EXPECT_EQ(presence.gone(), TruckPresence::Gone::left) << "he says so after all";
}

}  // namespace

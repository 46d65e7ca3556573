// What counts as a base that has moved, and from when on what is seen holds.
#include <gtest/gtest.h>

#include "app/base_watch.hpp"

namespace {

using namespace berm;
using namespace berm::app;

class BaseMoved : public ::testing::Test {
protected:
  bool step(std::uint8_t state, std::uint8_t reason = BERM_STOP_NONE, bool map_void = false) {
    Observation o;
    o.kernel_state = state;
    o.stop_reason = reason;
    o.latched = state == BERM_STATE_STOPPED || state == BERM_STATE_FAULT;
    return watch_.step(o, map_void);
  }
  BaseWatch watch_;
};

TEST_F(BaseMoved, IsToldOnceAndNotBeforeTheReset) {
  EXPECT_FALSE(step(BERM_STATE_RUN));
  EXPECT_FALSE(step(BERM_STATE_STOPPING, BERM_STOP_BASE_MOVED));
  EXPECT_FALSE(step(BERM_STATE_STOPPED, BERM_STOP_BASE_MOVED, true));
  EXPECT_TRUE(step(BERM_STATE_STANDBY, BERM_STOP_UNKNOWN_GROUND, true));
  EXPECT_FALSE(step(BERM_STATE_STANDBY, BERM_STOP_UNKNOWN_GROUND, true));
  EXPECT_FALSE(step(BERM_STATE_RUN));
}

TEST_F(BaseMoved, IsRememberedWhenAFaultComesOnTop) {
  step(BERM_STATE_STOPPING, BERM_STOP_BASE_MOVED);
  EXPECT_FALSE(step(BERM_STATE_FAULT, BERM_STOP_STATE_FRAME, true));
  EXPECT_TRUE(step(BERM_STATE_STANDBY));
}

// The emergency stop keeps its reason; that the base moved in it shows in the kernel's map alone.
TEST_F(BaseMoved, ShowsInAVoidMapWhereAnotherStopCameFirst) {
  step(BERM_STATE_STOPPED, BERM_STOP_EMERGENCY, false);
  step(BERM_STATE_STOPPED, BERM_STOP_EMERGENCY, true);
  EXPECT_TRUE(step(BERM_STATE_STANDBY, BERM_STOP_UNKNOWN_GROUND, true));
}

TEST_F(BaseMoved, IsNotEveryLatchedStopNorAMapThatIsRelearned) {
  step(BERM_STATE_STOPPED, BERM_STOP_EMERGENCY);
  EXPECT_FALSE(step(BERM_STATE_STANDBY));
  EXPECT_FALSE(step(BERM_STATE_RUN, BERM_STOP_NONE, true));
  EXPECT_FALSE(step(BERM_STATE_STANDBY, BERM_STOP_UNKNOWN_GROUND, true));
  EXPECT_FALSE(step(BERM_STATE_RUN));
}

}  // namespace

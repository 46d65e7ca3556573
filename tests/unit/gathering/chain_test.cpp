#include "gathering/kinematic_chain.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "gathering/epoch_counter.hpp"

namespace berm::app {
namespace {

constexpr double kPi = 3.14159265358979323846;

// By hand from the four elementary motions.
TEST(KinematicChain, LinkIsFourElementaryMotions) {
  const DhLink link{0.3, 0.7, -0.4, 1.1, DhLink::Joint::kRevolute, 0};
  const Eigen::Isometry3d by_hand = Eigen::AngleAxisd(0.3 + 0.25, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(0, 0, 0.7) *
                                    Eigen::Translation3d(-0.4, 0, 0) * Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitX());
  EXPECT_LT((dh_transform(link, 0.25).matrix() - by_hand.matrix()).norm(), 1e-14);
  const DhLink slide{0.3, 0.7, -0.4, 1.1, DhLink::Joint::kPrismatic, 0};
  EXPECT_NEAR(dh_transform(slide, 0.25).translation().z(), 0.95, 1e-14);
  EXPECT_LT((dh_transform(slide, 0.25).linear() - dh_transform(slide, 0.0).linear()).norm(), 1e-14);
}

// A planar arm of two links has a closed form; then a scanner whose plane stands upright.
TEST(KinematicChain, TwoLinksAndAnUprightScanner) {
  const KinematicChain chain({{0, 0, 2.0, 0, DhLink::Joint::kRevolute, 0}, {0, 0, 1.0, 0, DhLink::Joint::kRevolute, 1}, {0, 0.5, 0, kPi / 2}});
  const double q[] = {0.4, -0.9};
  const Eigen::Isometry3d pose = chain.pose(q);
  EXPECT_NEAR(pose.translation().x(), 2.0 * std::cos(0.4) + std::cos(-0.5), 1e-12);
  EXPECT_NEAR(pose.translation().y(), 2.0 * std::sin(0.4) + std::sin(-0.5), 1e-12);
  EXPECT_NEAR(pose.translation().z(), 0.5, 1e-12);
  EXPECT_LT((pose.linear().col(1) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);  // the beam of 90 degrees points up
  EXPECT_LT((pose.linear().col(0) - Eigen::Vector3d(std::cos(-0.5), std::sin(-0.5), 0)).norm(), 1e-12);
  EXPECT_THROW(chain.pose({}), std::out_of_range);
  EXPECT_TRUE(KinematicChain().pose({}).matrix().isIdentity());
}

bool begins(EpochCounter& counter, double pan) { return counter.begins_with(Eigen::AngleAxisd(pan, Eigen::Vector3d::UnitZ()).toRotationMatrix()); }

TEST(EpochCounter, ReversalStandstillFullTurn) {
  EpochCounter counter(EpochRule{});
  EXPECT_TRUE(begins(counter, 0.0));
  for (int i = 1; i <= 50; ++i) EXPECT_FALSE(begins(counter, 0.01 * i)) << i;
  EXPECT_TRUE(begins(counter, 0.49));  // back
  EXPECT_FALSE(begins(counter, 0.48));
  EXPECT_TRUE(begins(counter, 0.48));  // still: every scan
  EXPECT_TRUE(begins(counter, 0.4801));
  EXPECT_FALSE(begins(counter, 0.49));  // on again: still in the epoch that the last still scan began
  EXPECT_FALSE(begins(counter, 0.50));
  EXPECT_TRUE(begins(counter, 0.49));
  EpochCounter spinning(EpochRule{});
  int epochs = 0;
  for (int i = 0; i < 1000; ++i) epochs += begins(spinning, 2.0 * kPi * i / 100.0) ? 1 : 0;
  EXPECT_EQ(epochs, 10);
}

}  // namespace
}  // namespace berm::app

// When the next swing is expected to begin, that it waits for the scanner that leads it, and what the guard's account says.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/guard_account.hpp"
#include "app/scan_wait.hpp"
#include "app/swing_forecast.hpp"
#include "app_bench/events.hpp"

namespace {

using namespace berm::app;
using berm::app_bench::Events;
using Work = SwingForecast::Work;

Lead lead_at(double ahead, bool triggered) {
  Lead lead;
  lead.ahead = ahead;
  lead.needed = {radians(90.0), radians(56.0)};
  lead.triggered = triggered;
  return lead;
}

TEST(ScanWait, ASwingWhoseScannerIsThereBeginsAtOnce) {
  const Events events;
  const ProgressLog log(events.fd());
  ScanWait wait;
  EXPECT_TRUE(wait.step(1.0, lead_at(radians(60.0), true), true, "to truck", log));
  wait.swing_began(1.0, lead_at(radians(60.0), true), "to truck", log);
  ASSERT_EQ(events.named("leads").size(), 1U);
  EXPECT_EQ(events.named("leads")[0].at("waited_s").get<double>(), 0.0);
  EXPECT_NEAR(events.named("leads")[0].at("ahead_deg").get<double>(), 60.0, 1e-9);
  EXPECT_TRUE(events.named("scanner_late").empty());
}

TEST(ScanWait, OneWhoseScannerIsOnItsWayWaitsUntilItIsThere) {
  const Events events;
  const ProgressLog log(events.fd());
  ScanWait wait;
  EXPECT_FALSE(wait.step(0.5, lead_at(radians(20.0), false), false, "to truck", log)) << "the boom is not up yet: no wait";
  for (double t = 1.0; t < 1.5; t += 0.02) EXPECT_FALSE(wait.step(t, lead_at(radians(40.0), false), true, "to truck", log));
  EXPECT_TRUE(wait.step(1.5, lead_at(radians(57.0), true), true, "to truck", log));
  wait.swing_began(1.5, lead_at(radians(57.0), true), "to truck", log);
  ASSERT_EQ(events.named("leads").size(), 1U);
  EXPECT_NEAR(events.named("leads")[0].at("waited_s").get<double>(), 0.5, 1e-9);
}

TEST(ScanWait, ForAScannerThatDoesNotComeItWaitsABoundedTimeAndSaysSo) {
  const Events events;
  const ProgressLog log(events.fd());
  ScanWait wait;
  double t = 1.0;
  for (; !wait.step(t, lead_at(radians(-20.0), false), true, "to dig", log) && t < 10.0; t += 0.02) {}
  EXPECT_NEAR(t - 1.0, ScanWait::at_most_s, 0.03);
  EXPECT_TRUE(wait.step(t + 0.02, lead_at(radians(-20.0), false), true, "to dig", log)) << "nor does it wait anew";
  ASSERT_EQ(events.named("scanner_late").size(), 1U);
  EXPECT_EQ(events.named("scanner_late")[0].at("way"), "to dig");
  wait.swing_began(t, lead_at(radians(-20.0), false), "to dig", log);
  EXPECT_FALSE(wait.step(t + 20.0, lead_at(radians(-20.0), false), true, "to truck", log)) << "the next swing waits again";
}

TEST(SwingForecast, ADigIsExpectedToEndAsFastAsItGoesAndTheLiftToBeAsShortAsTheShortestOfLate) {
  SwingForecast forecast;
  EXPECT_GT(forecast.step(0.0, Work::other), 1e6);
  EXPECT_GT(forecast.step(1.0, Work::digs, 0.0), 1e6) << "nothing is known of it yet";
  EXPECT_NEAR(forecast.step(2.0, Work::digs, 0.25), 3.0 + 0.8, 1e-9);
  EXPECT_NEAR(forecast.step(4.0, Work::digs, 0.75), 1.0 + 0.8, 1e-9);
  forecast.step(5.0, Work::lifts);
  EXPECT_NEAR(forecast.step(5.3, Work::lifts), 0.5, 1e-9);
  for (double began = 10.0; began < 60.0; began += 10.0) {
    forecast.step(began, Work::lifts);
    forecast.step(began + (began == 40.0 ? 1.2 : 1.6), Work::waits);
    EXPECT_EQ(forecast.step(began + 2.5, Work::waits), 0.0) << "which is none of the lift's time";
    forecast.step(began + 3.0, Work::other);
  }
  forecast.step(60.0, Work::lifts);
  EXPECT_NEAR(forecast.step(60.2, Work::lifts), 1.0, 1e-9);
}

TEST(GuardAccount, WhatWasNotSeenIsCountedApart) {
  GuardAccount account;
  account.slowed(Skyline::Blocking{Skyline::Blocking::What::ground, 0.0, 6.0, 1.5}, 0.01);
  account.slowed(Skyline::Blocking{Skyline::Blocking::What::ground, 0.0, 6.0, std::numeric_limits<double>::infinity()}, 0.01);
  account.slowed(std::nullopt, 0.01);
  EXPECT_NEAR(account.seconds(), 0.03, 1e-12);
  EXPECT_NEAR(account.unseen_seconds(), 0.01, 1e-12);
}

}  // namespace

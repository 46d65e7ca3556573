// Each rule of what a bed must show: a drawn bed with the evidence just enough, and just too little.
#include "recognition/bed_verification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawn_bed.hpp"
#include "recognition/bed_class.hpp"
#include "recognition/rays_of_sweep.hpp"

namespace berm::app {
namespace {

TruckRangeSet verified_ranges() { return read_truck_ranges(BERM_TRUCK_RANGES); }

// A drawn bed as it stands, with evidence that only the rules themselves are asked about.
struct Case {
  explicit Case(const DrawnBed& bed) : sweep(make_fans(sweep_of(bed), drawn_viewpoint)) {
    fit.pose.middle = {bed.x, bed.y, bed.top};
    fit.pose.yaw = bed.yaw, fit.pose.length = bed.length, fit.pose.width = bed.width, fit.pose.thickness = bed.thickness;
    fit.pose.open_end = bed.rear_wall ? 0 : -1;
    fit.converged = true;
    bed_is_seen();
  }
  void bed_is_seen() {
    i = {};
    i.evidence.score = 300.0, i.evidence.outer_face = 100, i.evidence.inner_face = 100, i.evidence.wall_top = 20;
    i.cab = i.cab_seen = 20.0, i.cab_end = 1;
  }
  // A cab beside whose returns few lie in the planes of the bed's sides.
  void with_own_cab() { i.evidence.score = 110.0, i.cab = 28.0, i.cab_seen = 30.0; }
  [[nodiscard]] std::string refused(bool of_refused = false) {
    i.pose = fit.pose;
    return refusal(sweep, i, fit, verified_ranges(), of_refused);
  }
  FanSweep sweep;
  BedInterpretation i;
  FittedBed fit;
};

void expect_refusal(Case& c, const std::string& reason) {
  const std::string why = c.refused();
  EXPECT_NE(why.find(reason), std::string::npos) << '"' << why << '"';
}

DrawnBed seen_from_behind() {
  DrawnBed bed;
  bed.yaw = std::numbers::pi / 2, bed.rear_wall = false;
  return bed;
}

TEST(BedVerification, TakesWhatIsSeenWell) {
  EXPECT_EQ(Case({}).refused(), "");
  EXPECT_EQ(Case(seen_from_behind()).refused(), "");
}

TEST(BedVerification, ABedNeedsEvidence) {
  Case c({});
  c.i.evidence.score = 80.0;
  EXPECT_EQ(c.refused(), "");
  c.i.evidence.score = 79.0;
  expect_refusal(c, "of the 80 needed");
}

TEST(BedVerification, FromBehindAnOpenRearLessEvidenceDoesWithInnerFacesAndACab) {
  Case c(seen_from_behind());
  const auto seen = [&](double score, int inner, double cab) { c.i.evidence.score = score, c.i.evidence.inner_face = inner, c.i.cab = c.i.cab_seen = cab; };
  seen(60.0, 40, 2.0);
  EXPECT_EQ(c.refused(), "");
  seen(59.0, 40, 2.0);
  expect_refusal(c, "of the 60 needed");
  seen(60.0, 39, 2.0);
  expect_refusal(c, "of the 80 needed");
  seen(60.0, 40, 1.9);
  expect_refusal(c, "of the 80 needed");
  DrawnBed aside = seen_from_behind();
  aside.yaw = 0.0;
  Case beside(aside);
  beside.i.evidence.score = 60.0;
  expect_refusal(beside, "of the 80 needed");
}

TEST(BedVerification, WithACabOfItsOwnFewReturnsOnInnerFacesDo) {
  Case c({});
  c.with_own_cab();
  c.i.evidence.inner_face = 11;
  EXPECT_EQ(c.refused(), "");
  c.i.evidence.inner_face = 10;
  expect_refusal(c, "has 10 returns on inner faces of its far walls, and needs 11");
  c.i.evidence.inner_face = 16;
  const auto expect_no_own_cab = [&](double score, double cab, double cab_seen) {
    c.i.evidence.score = score, c.i.cab = cab, c.i.cab_seen = cab_seen;
    expect_refusal(c, "and needs 17");
  };
  expect_no_own_cab(109.0, 28.0, 30.0);
  expect_no_own_cab(110.0, 27.0, 30.0);
  expect_no_own_cab(110.0, 28.0, 46.0);  // more than a third of it may be the sides
  c.i.cab_seen = 45.0;
  EXPECT_EQ(c.refused(), "");
  c.i.cab = c.i.cab_seen = 20.0, c.i.evidence.inner_face = 17;
  EXPECT_EQ(c.refused(), "");
}

TEST(BedVerification, WithACabOfItsOwnManyReturnsOnInnerFacesDoWithoutOuterOnes) {
  Case c({});
  c.i.evidence.outer_face = 12;
  EXPECT_EQ(c.refused(), "");
  c.i.evidence.outer_face = 11;
  expect_refusal(c, "on outer faces");
  c.with_own_cab();
  c.i.evidence.inner_face = 90;
  EXPECT_EQ(c.refused(), "");
  c.i.evidence.inner_face = 89;
  expect_refusal(c, "on outer faces");
  c.i.evidence.inner_face = 90, c.i.cab = 27.0;
  expect_refusal(c, "on outer faces");
}

TEST(BedVerification, TheGroundIsSeenWhateverIsLikeACab) {
  DrawnBed low;
  low.ground = 0.0;  // 1.6 m below the tops
  Case c(low);
  c.i.evidence.inner_face = 100;
  expect_refusal(c, "where the ground would be");
  c.with_own_cab();
  expect_refusal(c, "where the ground would be");
}

// What is seen beyond the far walls is level with the tops: all that was seen there, and sixty returns more.
TEST(BedVerification, LevelGroundIsAPitWhateverIsLikeACab) {
  Case c({});
  const Eigen::Matrix3d turn = c.fit.pose.rotation();
  int more = 60;
  for (FanReturn& r : c.sweep.returns) {
    Eigen::Vector3d p = turn.transpose() * (r.at() - c.fit.pose.middle);
    const bool beyond = p.y() > 1.4 && p.y() < 3.0, far_off = p.y() > 6.0 && more > 0;
    if (!beyond && !far_off) continue;
    if (far_off) p.x() = 0.05 * --more - 1.5, p.y() = 2.0;
    p.z() = 0.0;
    r.place = (c.fit.pose.middle + turn * p).cast<float>();
  }
  ASSERT_EQ(more, 0);
  expect_refusal(c, "a pit");
  c.with_own_cab();
  expect_refusal(c, "a pit");
}

// 5 m of it are the bed, and a load hides most of the far side.
TEST(BedVerification, WithACabOfItsOwnWhatGoesOnBeyondTheBedIsNoContainer) {
  DrawnBed container;
  container.length = 8.6, container.x = 0.0, container.y = 11.0, container.yaw = 0.0, container.cab = false, container.load = container.top - 0.25;
  Case c(container);
  c.fit.pose.length = 5.0, c.fit.pose.middle.x() -= 1.8;
  expect_refusal(c, "longer than every class");
  c.with_own_cab();
  expect_refusal(c, "longer than every class");
  c.i.cab = 40.0, c.i.cab_seen = 41.0;
  EXPECT_EQ(c.refused(), "");
  c.i.cab = 39.0;
  expect_refusal(c, "longer than every class");
  c.i.cab = 40.0, c.i.evidence.score = 109.0;
  expect_refusal(c, "longer than every class");
  c.i.cab = 20.0, c.i.cab_seen = 100.0;
  EXPECT_EQ(c.refused(), "");
}

TEST(BedVerification, WithAnotherEndThanWhatWasRefusedItNeedsACab) {
  Case c({});
  c.i.cab_seen = 28.0;
  EXPECT_EQ(c.refused(true), "");
  c.i.cab_seen = 27.0;
  EXPECT_EQ(c.refused(true), "with another end it is like a bed, but has no cab");
  EXPECT_EQ(c.refused(false), "");
}

TEST(BedVerification, ALengthThatItsDeviationLeavesOpenIsOfTheClass) {
  TruckRangeSet ranges = verified_ranges();
  ranges.classes.resize(1);
  ranges.slack = 0.1;
  ranges.classes[0].inside_length = {5.2, 6.0}, ranges.classes[0].inside_width = {2.2, 2.6};
  const DrawnBed bed;
  FittedBed known = fit_bed(Case(bed).fit.pose, rays_near(make_fans(sweep_of(bed), drawn_viewpoint), Case(bed).fit.pose), 3, ranges.bed_sizes()), unsure;
  ASSERT_TRUE(known.converged);
  ASSERT_LT(std::sqrt(known.covariance(6, 6)), 0.05);
  unsure.converged = true, unsure.pose = known.pose;  // without a statement
  const auto of_length = [&](FittedBed& fit, double length) {
    fit.pose.length = length;
    return !some_classes_of(fit, ranges).classes.empty();
  };
  for (const double out : {5.1 - 0.11, 6.1 + 0.11}) {
    EXPECT_TRUE(of_length(unsure, out)) << out;
    EXPECT_FALSE(of_length(known, out)) << out;
  }
  for (const double out : {5.1 - 0.13, 6.1 + 0.13}) EXPECT_FALSE(of_length(unsure, out)) << out;
  for (const double near : {5.1 - 0.5 * std::sqrt(known.covariance(6, 6)), 6.1 + 0.5 * std::sqrt(known.covariance(6, 6))}) EXPECT_TRUE(of_length(known, near)) << near;
  unsure.converged = false;
  EXPECT_FALSE(of_length(unsure, 5.1 - 0.05)) << "no fit, no deviation";
}

}  // namespace
}  // namespace berm::app

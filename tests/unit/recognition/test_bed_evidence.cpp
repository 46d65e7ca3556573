// Rays weighed four at a time against the model that they are followed through one by one.
#include "recognition/bed_constraints.hpp"
#include "recognition/bed_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace berm::app {
namespace {

constexpr unsigned kDrawnRaysSeed = 20261;

// Of places in the bed's frame.
Ray ray_in(const BedPose& pose, const Eigen::Vector3d& head, const Eigen::Vector3d& at, bool upright) {
  return {(pose.middle + pose.rotation() * head).cast<float>(), (pose.middle + pose.rotation() * at).cast<float>(), upright};
}

// From above and aside, to places on the bed's faces and tops, in it, and about it.
class DrawnRays {
 public:
  explicit DrawnRays(const BedPose& pose) : pose_(pose) {}
  Ray draw() {
    const double u = of(-0.75, 0.75) * pose_.length, v = of(-0.75, 0.75) * pose_.width, w = of(-2.4, 1.8);
    Eigen::Vector3d at(u, v, w);
    const int face = static_cast<int>(of(0.0, 6.0)), side = of(-1.0, 1.0) > 0.0 ? 1 : -1;
    const bool outer = of(-1.0, 1.0) > 0.0;
    if (face < 2) at[face] = side * pose_.face(face, side, outer) + of(-0.2, 0.2);
    if (face < 2) at.z() = of(-0.8, 0.4);
    if (face == 2) at.z() = of(-0.2, 0.2);
    const double away = of(4.0, 12.0), bearing = of(-3.1, 3.1);
    const Eigen::Vector3d head(away * std::cos(bearing), away * std::sin(bearing), of(0.3, 4.0));
    return ray_in(pose_, head, at, of(-1.0, 1.0) > 0.0);
  }

 private:
  double of(double low, double high) { return std::uniform_real_distribution(low, high)(draws_); }
  BedPose pose_;
  std::mt19937 draws_{kDrawnRaysSeed};
};

BedPose level_bed(int open_end) {
  BedPose pose;
  pose.middle = {4.0, -6.0, 1.5};
  pose.yaw = 0.7, pose.pitch = 0.02, pose.roll = -0.03;
  pose.length = 4.8, pose.width = 2.4, pose.thickness = 0.1;
  pose.open_end = open_end;
  return pose;
}

// What a ray meets alone adds to the evidence.
double weight_of(const RayMeeting& m) {
  switch (m.what) {
    case Meeting::outer_face: return fit(m.off, kRangeGate);
    case Meeting::above_face: return -kAbove;
    case Meeting::wall_top: return kTop * fit(m.off, kTopGate);
    case Meeting::inside: return m.end.z() < -kDeepest ? -kThrough : kInside;
    case Meeting::inner_face: return kInside + (1.0 - kInside) * fit(m.off, kRangeGate);
    case Meeting::through_face:
    case Meeting::through_inner: return -kThrough;
    case Meeting::through_top: return -0.5 * kThrough;
    case Meeting::none:
    case Meeting::below_side:
    case Meeting::before:
    case Meeting::over: break;
  }
  return 0.0;
}

TEST(BedEvidence, CountsWhatEachRayMeets) {
  for (const int open_end : {-1, 0, 1}) {
    const BedPose pose = level_bed(open_end);
    DrawnRays rays(pose);
    int differs = 0, met[12] = {};
    constexpr int kRays = 20000;
    for (int k = 0; k < kRays; ++k) {
      const Ray ray = rays.draw();
      const RayMeeting m = meet(pose, pose.rotation(), ray);
      ++met[static_cast<int>(m.what)];
      const BedEvidence e = weigh(pose, {ray});
      const auto is = [&](Meeting what) { return m.what == what ? 1 : 0; };
      const bool deep = m.what == Meeting::inside && m.end.z() < -kDeepest;
      const bool same = e.outer_face == is(Meeting::outer_face) && e.inner_face == is(Meeting::inner_face) && e.wall_top == is(Meeting::wall_top) &&
                        e.inside == (deep ? 0 : is(Meeting::inside)) && e.before == is(Meeting::before) && e.over == is(Meeting::over) && e.above_face == is(Meeting::above_face) &&
                        e.through == is(Meeting::through_face) + is(Meeting::through_inner) + is(Meeting::through_top) + (deep ? 1 : 0);
      const double of_place = kAbove * e.above_inner + kUpright * e.not_soil + kLevel * e.level_inside + (open_end != 0 ? kOpenEnd : 0.0) + tilt_cost(pose.pitch, pose.roll);
      if (!same || std::abs(e.score + of_place - weight_of(m)) > 1e-3) ++differs;
    }
    EXPECT_LE(differs, 4) << "rays a micrometre from a limit; open end " << open_end << ", seed " << kDrawnRaysSeed;
    for (const Meeting what : {Meeting::none, Meeting::before, Meeting::outer_face, Meeting::below_side, Meeting::above_face, Meeting::wall_top, Meeting::inside, Meeting::inner_face,
                               Meeting::over, Meeting::through_face, Meeting::through_inner, Meeting::through_top})
      EXPECT_GT(met[static_cast<int>(what)], 20) << static_cast<int>(what);
  }
}

// Rays that a fit passes over eight at a time would have made no statement.
TEST(BedEvidence, RaysThatAreTakenForSilentSayNothing) {
  for (const int open_end : {0, 1, -1}) {
    BedPose pose = level_bed(open_end);
    pose.pitch = 0.02, pose.roll = -0.015;
    DrawnRays drawn(pose);
    std::vector<Ray> rays;
    for (int k = 0; k < 20000; ++k) rays.push_back(drawn.draw());
    constexpr double kAll = 100.0;  // m
    const std::vector<BedConstraint> all = constraints(pose, rays), some = FitRays(pose, rays, PackedRays(rays), kAll, kAll).constraints(pose);
    ASSERT_EQ(all.size(), some.size()) << "open end " << open_end << ", seed " << kDrawnRaysSeed;
    EXPECT_GT(all.size(), 2000U);
    for (std::size_t k = 0; k < all.size(); ++k) {
      ASSERT_TRUE(all[k].head == some[k].head && all[k].at == some[k].at) << k;
      ASSERT_TRUE(all[k].edge == some[k].edge && all[k].bound.axis == some[k].bound.axis && all[k].sense == some[k].sense) << k;
    }
  }
}

// Of any number of rays, and of those alone that may meet the bed.
TEST(BedEvidence, OfManyRaysIsTheSum) {
  const BedPose pose = level_bed(0);
  const double tilt = tilt_cost(pose.pitch, pose.roll);  // of the bed, whatever the rays
  DrawnRays drawn(pose);
  std::vector<Ray> rays;
  double sum = -tilt;
  for (int k = 0; k < 150; ++k) {
    rays.push_back(drawn.draw());
    sum += weigh(pose, {rays.back()}).score + tilt;
    const PackedRays packed(rays);
    ASSERT_NEAR(weigh(pose, packed).score, sum, 1e-3) << k;
    ASSERT_EQ(score_of(pose, packed), weigh(pose, packed).score);
    BedPose near = pose;
    near.middle.x() += 0.1, near.length += 0.1;
    ASSERT_NEAR(score_of(near, packed.meeting(pose, 0.25)), score_of(near, packed), 1e-3) << k;
  }
  EXPECT_EQ(score_of(pose, PackedRays()), -tilt);
  EXPECT_LT(PackedRays(rays).meeting(pose, 0.25).eights().size(), PackedRays(rays).eights().size());
}

TEST(BedEvidence, ATiltCostsMoreTheFartherItGoes) {
  BedPose p = level_bed(0);
  p.pitch = p.roll = 0.0;
  EXPECT_EQ(score_of(p, PackedRays()), 0.0);
  p.pitch = kTiltUsual;
  EXPECT_NEAR(score_of(p, PackedRays()), -1.0, 1e-9);
  p.roll = -2.0 * kTiltUsual;
  EXPECT_NEAR(score_of(p, PackedRays()), -5.0, 1e-9);
}

TEST(BedEvidence, ReturnsAboveAnInnerFaceCountAgainstTheBed) {
  const BedPose p = level_bed(0);
  const double face = p.width / 2;
  const auto at = [&](double v, double w) {
    return std::vector<Ray>{ray_in(p, {0.0, 6.0, 3.0}, {0.3, v, w}, false)};
  };
  EXPECT_EQ(weigh(p, at(-face, 0.2)).above_inner, 1);
  EXPECT_EQ(weigh(p, at(-face, 0.5)).above_inner, 0) << "of something higher";
  EXPECT_EQ(weigh(p, at(-face - 0.2, 0.2)).above_inner, 0) << "behind the wall";
  EXPECT_EQ(weigh(p, at(-face, -0.2)).above_inner, 0);
}

// Within and over the opening: a lid, a heap, and what is too steep for one.
TEST(BedEvidence, TellsSoilFromWhatIsTooSteep) {
  const BedPose p = level_bed(0);
  const auto at = [&](double v, double w, bool upright) {
    return weigh(p, std::vector<Ray>{ray_in(p, {0.0, 6.0, 3.0}, {0.3, v, w}, upright)});
  };
  EXPECT_EQ(at(0.0, 0.0, false).level_inside, 1);
  EXPECT_EQ(at(0.0, -0.3, false).below_inside, 1);
  EXPECT_EQ(at(0.0, 0.3, false).above_inside, 1);
  EXPECT_EQ(at(0.0, 0.3, false).not_soil, 0) << "a heap";
  EXPECT_EQ(at(0.0, 0.3, true).not_soil, 1) << "upright";
  EXPECT_EQ(at(0.9, 0.5, false).not_soil, 1) << "too high beside the wall";
  EXPECT_EQ(at(0.0, 1.7, true).not_soil, 0) << "too high to be of the load";
}

TEST(BedEvidence, TellsWhatOfItAnEndsOuterFaceMakes) {
  BedPose pose;
  pose.length = 5.0, pose.width = 2.4, pose.thickness = 0.1;
  const auto weighed = [&](const Eigen::Vector3d& head, const Eigen::Vector3d& at) { return weigh(pose, std::vector<Ray>(30, ray_in(pose, head, at, true))); };
  const BedEvidence end = weighed({9.0, 0.0, 1.0}, {pose.face(0, 1, true), 0.3, -0.3}), side = weighed({0.0, 8.0, 1.0}, {0.3, pose.face(1, 1, true), -0.3});
  EXPECT_NEAR(end.end_face, 30.0, 0.1);
  EXPECT_NEAR(end.score, 30.0, 0.1);
  EXPECT_NEAR(side.score, 30.0, 0.1);
  EXPECT_EQ(side.end_face, 0.0);
  const BedScore uncounted = score_with_ends(pose, PackedRays(std::vector<Ray>(30, ray_in(pose, {9.0, 0.0, 1.0}, {pose.face(0, 1, true), 0.3, -0.3}, true))));
  EXPECT_EQ(uncounted.score, end.score);
  EXPECT_EQ(uncounted.end_face, end.end_face);
}

}  // namespace
}  // namespace berm::app

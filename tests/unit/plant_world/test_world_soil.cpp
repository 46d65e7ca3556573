// Rain or sun: what is dug and poured after it is another soil, property by property.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bench.hpp"
#include "scratch.hpp"

namespace berm::plant {
namespace {

using bench::degree;

// The heights of the ground, row by row, or of the truck's bed (file + ".truck").
struct Heights {
  explicit Heights(const std::string& path) {
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream(line) >> x0 >> y0 >> cell >> columns >> rows;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      for (std::string h; std::getline(words, h, ',');) z.push_back(h == "nan" ? nothing : std::stod(h));
    }
  }
  double at(int ix, int iy) const { return z.at(static_cast<std::size_t>(iy * columns + ix)); }
  static constexpr double nothing = -100;  // where there is no bed
  double x0 = 0, y0 = 0, cell = 0;
  int columns = 0, rows = 0;
  std::vector<double> z;
};

// The slopes of the steps between neighbours that both count, ascending.
template <class Counts>
std::vector<double> slopes(const Heights& h, Counts counts) {
  std::vector<double> slope;
  for (int iy = 1; iy < h.rows; ++iy)
    for (int ix = 1; ix < h.columns; ++ix)
      if (counts(ix, iy)) {
        if (counts(ix - 1, iy)) slope.push_back(std::abs(h.at(ix, iy) - h.at(ix - 1, iy)) / h.cell);
        if (counts(ix, iy - 1)) slope.push_back(std::abs(h.at(ix, iy) - h.at(ix, iy - 1)) / h.cell);
      }
  std::sort(slope.begin(), slope.end());
  return slope;
}

// A dig and a dump into the truck in the soil as it was, then the change, if any, a dig that is watched, and a dump to the truck or beside it.
class WorldSoil : public ::testing::Test {
 protected:
  struct Outcome {
    double least_factor = 1.0;   // of the joints' speeds, that the soil left in the second dig
    double payload_kg = 0, stays_kg = 0, poured_kg = 0;  // of the second pass; poured into the truck
    double first_stays_kg = 0;   // of the dump before the change
    Heights before, after, bed;  // the second dig and dump
  };
  Outcome run(const std::optional<SoilChange>& change, double dump_at) {
    WorldConfig c = bench::site();
    c.terrain.roughness = 0;
    World w(c, shape, 1, 1);
    double t = 0;
    bench::dump(w, shape, t, bench::dig(w, shape, t, 12 * degree), 92 * degree);
    const double first_stays = w.payload_kg(), had = w.truth().truck_load_kg[0];
    if (change) w.change_soil(*change);
    const Heights before = heights(w);
    double least = 1.0;
    const JointState lifted = dig_watched(w, t, least);
    const double payload = w.payload_kg();
    bench::dump(w, shape, t, lifted, dump_at);
    return {least, payload, w.payload_kg(), w.truth().truck_load_kg[0] - had, first_stays, before, heights(w), Heights(file() + ".truck")};
  }
  // As bench::dig, with what the soil leaves of the speeds.
  JointState dig_watched(World& w, double& t, double& least) const {
    JointState at = bench::reach(shape, swing, 7.9, -1.2, -105 * degree);
    const auto go = [&](const JointState& to, double seconds) {
      const int steps = static_cast<int>(std::lround(seconds * 100));
      const JointState from = at;
      for (int i = 1; i <= steps; ++i) {
        JointState now = from;
        for (size_t k = 0; k < 4; ++k) now.angle[k] += (to.angle[k] - from.angle[k]) * i / steps;
        t += 0.01;
        const DigForces forces = w.step(t, 0.01, now, at);
        least = std::min(least, *std::min_element(forces.resist_speed_factor.begin(), forces.resist_speed_factor.end()));
        at = now;
      }
    };
    for (int i = 1; i <= 30; ++i) {
      const double f = i / 30.0;
      go(bench::reach(shape, swing, 7.8 - 2.0 * f, -1.9 + 1.4 * f * f, (-105 - 25 * f) * degree), 0.1);
    }
    go(bench::reach(shape, swing, 5.0, 0.6, -180 * degree), 1.5);
    go(bench::reach(shape, swing, 5.0, 1.8, -180 * degree), 1.0);
    return at;
  }
  std::string file() const { return scratch.path("ground.csv"); }
  Heights heights(const World& w) const {
    w.write_terrain(file());
    return Heights(file());
  }
  // The steepest side of the heap that was dumped beside, on level ground.
  static double heap_slope(const Outcome& o) {
    return slopes(o.after, [&](int ix, int iy) { return o.after.at(ix, iy) > o.before.at(ix, iy) + 0.01; }).back();
  }
  // Of the steps where the bucket passed the steep ones, but for those of the bank above that broke off uncut.
  static double cut_slope(const Outcome& o) {
    const auto all = slopes(o.after, [&](int ix, int iy) {
      const double x = o.after.x0 + (ix + 0.5) * o.after.cell, y = o.after.y0 + (iy + 0.5) * o.after.cell;
      const double across = -x * std::sin(swing) + y * std::cos(swing);
      return std::abs(across) < 0.4 && o.after.at(ix, iy) < o.before.at(ix, iy) - 0.1;
    });
    return all.at(all.size() * 9 / 10);
  }

  const ImplementShape shape = bench::machine();
  const SoilConfig dry;  // as the site has it
  SoilChange same{0.0, dry.repose, dry.bank_slope, dry.resistance, dry.stick_fraction};
  const test::Scratch scratch;
  static constexpr double swing = -8 * degree, beside = -60 * degree, truck = 92 * degree;
};

TEST_F(WorldSoil, AChangeToTheSameSoilIsNone) {
  const Outcome none = run(std::nullopt, truck), change = run(same, truck);
  EXPECT_EQ(none.after.z, change.after.z);
  EXPECT_EQ(none.bed.z, change.bed.z);
  EXPECT_EQ(none.least_factor, change.least_factor);
}

TEST_F(WorldSoil, MoreOfItStaysInTheBucket) {
  SoilChange wet = same;
  wet.stick_fraction = 0.1;
  const Outcome o = run(wet, truck);
  EXPECT_EQ(o.first_stays_kg, 0.0) << "before the change nothing did";
  EXPECT_GT(o.payload_kg, 1000);
  EXPECT_NEAR(o.stays_kg, 0.1 * o.payload_kg, 1.0);
}

TEST_F(WorldSoil, ItResistsTheBucketOtherwise) {
  const Outcome as_it_was = run(std::nullopt, truck);
  ASSERT_LT(as_it_was.least_factor, 0.95) << "the soil is hardly felt: this shows nothing";
  SoilChange other = same;
  other.resistance = 0.6 * dry.resistance;
  EXPECT_NEAR(1 - run(other, truck).least_factor, 0.6 * (1 - as_it_was.least_factor), 1e-6);
}

TEST_F(WorldSoil, ItHeapsAtItsOwnReposeOnTheGround) {
  EXPECT_NEAR(heap_slope(run(std::nullopt, beside)), dry.repose, 0.08);
  SoilChange wet = same;
  wet.repose = 0.9;
  EXPECT_NEAR(heap_slope(run(wet, beside)), 0.9, 0.08);
}

// The second load is poured on the first, which stands as it did until then.
TEST_F(WorldSoil, ItHeapsAtItsOwnReposeInATruckThatIsThereAlready) {
  const auto highest = [](const Outcome& o) { return *std::max_element(o.bed.z.begin(), o.bed.z.end()); };
  SoilChange wet = same, slack = same;
  wet.repose = 0.9;
  slack.repose = 0.4;
  const double as_it_was = highest(run(std::nullopt, truck));
  EXPECT_GT(highest(run(wet, truck)), as_it_was + 0.1);
  EXPECT_LT(highest(run(slack, truck)), as_it_was - 0.1);
}

TEST_F(WorldSoil, CutBankStandsAtItsOwnSlope) {
  SoilChange slack = same;
  slack.repose = 0.4;
  slack.bank_slope = 0.7;
  EXPECT_NEAR(cut_slope(run(std::nullopt, truck)), dry.bank_slope, 0.08);
  EXPECT_NEAR(cut_slope(run(slack, truck)), 0.7, 0.08);
}

// A bucket of it weighs by volume what it did: as much as the truck then has of it, and its bed by volume.
TEST_F(WorldSoil, ItsDensitiesStay) {
  const Outcome o = run(SoilChange{0.0, 0.9, 1.7, 0.65, 0.1}, truck);
  EXPECT_GT(o.poured_kg, 500);
  EXPECT_NEAR(o.poured_kg, o.payload_kg - o.stays_kg, 1.0);
  EXPECT_LE(o.payload_kg, 1.2 * 1340 + 1e-6);
}

}  // namespace
}  // namespace berm::plant

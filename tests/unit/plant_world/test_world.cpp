#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "bench.hpp"
#include "scratch.hpp"

namespace berm::plant {
namespace {

using bench::degree;

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

TEST(World, PassesMoveSoilFromTheBenchIntoTheTruck) {
  const ImplementShape s = bench::machine();
  World w(bench::site(), s, 1, 1);
  double t = 0;
  for (int pass = 0; pass < 4; ++pass) {
    const JointState lifted = bench::dig(w, s, t, (12 - 8 * pass) * degree);
    Truth truth = w.truth();
    EXPECT_GT(truth.payload_kg, 500) << pass;
    EXPECT_LE(truth.payload_kg, 1.2 * 1340 + 1e-6);
    EXPECT_DOUBLE_EQ(truth.payload_kg, w.payload_kg());
    const double before = truth.truck_load_kg[0], payload = truth.payload_kg;
    bench::dump(w, s, t, lifted, (85 + 7 * pass) * degree);
    truth = w.truth();
    EXPECT_EQ(truth.payload_kg, 0);
    EXPECT_NEAR(truth.truck_load_kg[0] - before, payload, 1);
    EXPECT_NEAR(truth.dug_kg, truth.truck_load_kg[0] + truth.payload_kg + truth.spilled_kg, 1e-6);
    EXPECT_NEAR(w.soil_masses().in_trucks, truth.truck_load_kg[0], 1e-6);
    EXPECT_EQ(w.soil_masses().spilled, truth.spilled_kg);
    EXPECT_LT(truth.spilled_kg, 1);
  }
  EXPECT_GT(w.truth().load_height_stddev_m, 0.01);
  EXPECT_GT(w.truth().load_centre_offset_m, 0.0);
}

TEST(World, BallastWeighsAndNeverFallsOut) {
  const ImplementShape s = bench::machine();
  WorldConfig site = bench::site();
  site.ballast_kg = 1500;
  World w(site, s, 1, 1);
  double t = 0;
  EXPECT_DOUBLE_EQ(w.payload_kg(), 1500);
  const JointState up = bench::reach(s, 0, 7.0, 2.0, -60 * degree);  // the mouth opens downward
  bench::move(w, t, up, up, 3.0);
  EXPECT_DOUBLE_EQ(w.payload_kg(), 1500);
  EXPECT_DOUBLE_EQ(w.truth().payload_kg, 1500);
  EXPECT_DOUBLE_EQ(w.truth().spilled_kg, 0);
}

TEST(World, DumpedBesideTheTruckIsSpilled) {
  const ImplementShape s = bench::machine();
  World w(bench::site(), s, 1, 1);
  double t = 0;
  const JointState lifted = bench::dig(w, s, t, 0);
  const double payload = w.payload_kg();
  bench::dump(w, s, t, lifted, -60 * degree);
  EXPECT_NEAR(w.truth().spilled_kg, payload, 1);
  EXPECT_EQ(w.truth().truck_load_kg[0], 0);
}

TEST(World, TrucksComeOneAfterTheOther) {
  WorldConfig c = bench::site();
  c.trucks[0].wait_s = 0;
  World w(c, bench::machine(), 1, 2);
  const JointState j = bench::reach(bench::machine(), 0, 6, 1, -90 * degree);
  double t = 0;
  EXPECT_TRUE(w.truck_parked());
  bench::move(w, t, j, j, 1);
  w.release_truck(t);
  EXPECT_TRUE(w.truck_leaving());
  EXPECT_FALSE(w.truck_parked());
  double parked = -1;
  while (t < 60 && parked < 0) {
    bench::move(w, t, j, j, 0.1);
    if (w.truck_parked()) parked = t;
  }
  EXPECT_NEAR(parked, 1 + 2 * 9.0, 0.3) << "9 s away and 9 s to come";
  EXPECT_FALSE(w.all_trucks_done());
  w.release_truck(t);
  bench::move(w, t, j, j, 10);
  EXPECT_TRUE(w.all_trucks_done());
  EXPECT_FALSE(w.truck_parked());
  EXPECT_FALSE(w.truck_leaving());
  EXPECT_EQ(w.movers().size(), 2u);
  EXPECT_EQ(w.movers()[0].name, "truck_1");
}

TEST(World, WithoutTrucksThereIsNothingToWaitFor) {
  World w(bench::site(), bench::machine(), 1, 0);
  EXPECT_FALSE(w.truck_parked());
  EXPECT_FALSE(w.all_trucks_done()) << "nothing was asked for, so nothing is done";
  w.release_truck(0);
  EXPECT_TRUE(w.movers().empty());
}

TEST(World, JudgesContacts) {
  const ImplementShape s = bench::machine();
  WorldConfig c = bench::site();
  MoverConfig m;
  m.name = "walker";
  m.height = 1.8;
  m.radius = 0.25;
  m.waypoints = {{-6, -3, 0}};
  c.movers = {m};
  World w(c, s, 1, 1);
  const OracleVerdict free = w.judge(0, bench::reach(s, 0, 6.5, 1.5, -170 * degree));
  EXPECT_FALSE(free.contact);
  EXPECT_GT(free.closest_m, 1);
  EXPECT_GT(free.ground_gap_m, 0);
  EXPECT_FALSE(w.judge(0, bench::reach(s, 0, 7.0, -2.4, -110 * degree)).contact) << "in the dig zone";
  const OracleVerdict ground = w.judge(0, bench::reach(s, -50 * degree, 6.0, -0.2, -110 * degree));
  EXPECT_TRUE(ground.contact);
  EXPECT_EQ(ground.what, "ground outside the dig zone");
  EXPECT_NEAR(ground.ground_gap_m, -0.2, 0.1);
  const OracleVerdict floor = w.judge(0, bench::reach(s, 0, 7.0, -3.5, -110 * degree));
  EXPECT_TRUE(floor.contact);
  EXPECT_EQ(floor.what, "floor of the dig zone");
  const OracleVerdict wall = w.judge(0, bench::reach(s, 90 * degree, 5.5, 0.1, -110 * degree));
  EXPECT_TRUE(wall.contact);
  EXPECT_EQ(wall.what.substr(0, 7), "truck_1");
  EXPECT_EQ(wall.closest_m, 0);
  const OracleVerdict person = w.judge(0, bench::reach(s, std::atan2(-3.0, -6.0), 6.7, 1.0, -110 * degree));
  EXPECT_TRUE(person.contact);
  EXPECT_EQ(person.what, "walker");
}

// The tail swings over someone who stands behind the machine.
TEST(World, WhoIsNotThereIsNotJudgedUntilSentAndMayBeAnother) {
  WorldConfig c;
  MoverConfig p;
  p.name = "late";
  p.height = 1.8, p.radius = 0.25;
  p.waypoints = {{0.0, 6.0, 0.0}};
  p.appears_s = 1e9;
  c.movers = {p};
  World world(c, bench::machine(), 1, 0);
  const JointState over_it = {{std::numbers::pi / 2, 0.4, -1.0, -1.0}, {}};
  world.step(0.01, 0.01, over_it, over_it);
  EXPECT_GT(world.judge(0.01, over_it).closest_m, 1e8);
  p.name = "another";
  p.waypoints = {{0.0, 6.5, 0.0}};
  world.send_mover(0, p, 0.02);
  world.step(0.02, 0.01, over_it, over_it);
  EXPECT_LT(world.judge(0.02, over_it).closest_m, 5.0);
  EXPECT_EQ(world.judge(0.02, over_it).what, "another");
  EXPECT_EQ(world.movers().back().y, 6.5);
}

TEST(World, TailHitsWhoStandsBehind) {
  WorldConfig c = bench::site();
  c.trucks.clear();
  MoverConfig m;
  m.name = "walker";
  m.height = 1.8;
  m.radius = 0.25;
  m.waypoints = {{-2.4, -1.6, 0}};
  c.movers = {m};
  World w(c, bench::machine(), 1, 0);
  EXPECT_FALSE(w.judge(0, bench::reach(bench::machine(), 0, 6, 2, -170 * degree)).contact);
  EXPECT_NEAR(w.judge(0, bench::reach(bench::machine(), 0, 6, 2, -170 * degree)).closest_m, 0.05, 1e-6);
  EXPECT_TRUE(w.judge(0, bench::reach(bench::machine(), 0.1, 6, 2, -170 * degree)).contact);
}

TEST(World, SameSeedSameBytes) {
  const ImplementShape s = bench::machine();
  const test::Scratch scratch;
  const auto run = [&](uint64_t seed, const std::string& name) {
    WorldConfig c = bench::site();
    c.scanner.range_stddev = 0.03;
    c.scanner.outlier_probability = 0.001;
    c.scanner.dust_probability = 0.001;
    c.trucks[0].place_stddev = 0.05;
    World w(c, s, seed, 1);
    double t = 0;
    const JointState j = bench::dig(w, s, t, 0);
    bench::dump(w, s, t, j, 90 * degree);
    std::string bytes;
    std::vector<berm_scan_packet> out;
    for (int i = 0; i < 100; ++i) {
      t += 0.01;
      out.clear();
      w.step(t, 0.01, j, j);
      w.scan(t, 0.01, j, j, PanState{}, PanState{}, out);
      for (const berm_scan_packet& p : out) {
        uint8_t wire[BERM_SCAN_PACKET_MAX_BYTES];
        const size_t n = berm_scan_encode(&p, wire);
        bytes.append(reinterpret_cast<const char*>(wire), n);
      }
    }
    const std::string path = scratch.path(name);
    w.write_terrain(path);
    return bytes + file_text(path) + file_text(path + ".truck");
  };
  const std::string a = run(7, "same_a"), b = run(7, "same_b"), other = run(8, "same_c");
  ASSERT_GT(a.size(), 100000u);
  EXPECT_TRUE(a == b);
  EXPECT_FALSE(a == other);
}

TEST(World, TerrainFileHasItsHeaderAndRows) {
  World w(bench::site(), bench::machine(), 1, 1);
  const test::Scratch scratch;
  const std::string path = scratch.path("terrain.csv");
  w.write_terrain(path);
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "-16,-16,0.1,320,320");
  int rows = 0;
  while (std::getline(in, line)) {
    ++rows;
    ASSERT_EQ(std::count(line.begin(), line.end(), ','), 319);
  }
  EXPECT_EQ(rows, 320);
  EXPECT_NE(file_text(path + ".truck").find("-0.9200"), std::string::npos) << "the empty bed's floor";
  EXPECT_THROW(w.write_terrain("/nonexistent/terrain.csv"), std::runtime_error);
}

TEST(World, TerrainFileIsWholeOrNotThere) {
  const World w(bench::site(), bench::machine(), 1, 1);
  const test::Scratch scratch;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit little{65536, before.rlim_max};
  const auto signalled = signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &little);
  std::string why;
  try {
    w.write_terrain(scratch.path("terrain.csv"));
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, signalled);
  EXPECT_EQ(why, scratch.path("terrain.csv") + ": cannot be written: File too large");
  EXPECT_TRUE(scratch.names().empty()) << scratch.names().front();
}

}  // namespace
}  // namespace berm::plant

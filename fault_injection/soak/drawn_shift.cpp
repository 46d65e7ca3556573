#include "soak/drawn_shift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "in_process/draw.hpp"

namespace berm::soak {

namespace {

using in_process::Draw;

// A stream of its own for each subject: a change to one leaves the others as they were.
enum Stream { stream_trucks = 1, stream_people = 2, stream_dust = 3, stream_soil = 4 };

constexpr int kTruckKinds = 24;
constexpr int kPeople = 3;
constexpr double kQuiet_s = 120.0;            // the ground is learned first
constexpr double kVisitEvery_s[2] = {900.0, 2400.0};
constexpr double kEntersShare = 0.5;
constexpr double kDustEvery_s[2] = {1200.0, 3600.0}, kDustFor_s[2] = {10.0, 90.0};
constexpr double kSoilEvery_s[2] = {3600.0, 7200.0};
constexpr double kShortestTruck_s = 150.0;    // no truck is loaded in less

// To the nearest multiple of a power of ten, as that is written: 36.1, and not 36.1 and some in the sixteenth digit.
double rounded(double x, double step) { return std::round(x / step) / std::round(1.0 / step); }

std::vector<DrawnTruck> draw_trucks(std::uint64_t seed) {
  Draw draw(seed, stream_trucks);
  std::vector<DrawnTruck> trucks;
  for (int i = 0; i < kTruckKinds; ++i) {
    DrawnTruck t{};
    t.length = rounded(draw.between(4.7, 5.5), 0.01);
    t.width = rounded(draw.between(2.36, 2.46), 0.01);
    t.height = rounded(draw.between(1.18, 1.40), 0.01);
    t.wall_top = rounded(draw.between(0.15, 0.45), 0.01);
    t.x = rounded(draw.between(-0.9, -0.4), 0.01);
    t.y = rounded(draw.between(6.65, 6.90), 0.01);
    t.yaw_deg = rounded(draw.between(176.0, 184.0), 0.1);
    t.wait_s = rounded(draw.chance(0.15) ? draw.between(60.0, 240.0) : draw.between(5.0, 40.0), 1.0);
    trucks.push_back(t);
  }
  return trucks;
}

// Behind the machine to its right, where no truck drives: past the region's rim, or some way into it.
DrawnPerson draw_person(Draw& draw, double seconds) {
  DrawnPerson person{rounded(draw.between(1.55, 1.95), 0.01), rounded(draw.between(0.20, 0.28), 0.01), rounded(draw.between(0.9, 1.7), 0.01), {}};
  double t = kQuiet_s;
  for (;;) {
    const double wait = draw.between(kVisitEvery_s[0], kVisitEvery_s[1]);
    t += wait;
    if (t > seconds) return person;
    DrawnVisit visit{rounded(t - wait < kQuiet_s + 1 ? wait * draw.unit() + kQuiet_s : wait, 1.0), draw.chance(kEntersShare), {}};
    const double r = visit.enters ? draw.between(5.0, 9.0) : draw.between(16.5, 18.0);
    const double bearing = draw.between(-2.6, -1.9);
    visit.way = {{{rounded(r * std::cos(bearing), 0.01), rounded(r * std::sin(bearing), 0.01)},
                  {rounded(r * std::cos(bearing - 0.15), 0.01), rounded(r * std::sin(bearing - 0.15), 0.01)}}};
    person.visits.push_back(visit);
  }
}

std::vector<DrawnDust> draw_dust(double seconds, std::uint64_t seed) {
  Draw draw(seed, stream_dust);
  std::vector<DrawnDust> dust;
  for (double t = draw.between(kQuiet_s, kDustEvery_s[1]); t < seconds; t += draw.between(kDustEvery_s[0], kDustEvery_s[1])) {
    const double thick = draw.chance(0.3) ? draw.between(0.3, 0.6) : draw.between(0.02, 0.12);
    dust.push_back({rounded(t, 0.1), rounded(draw.between(kDustFor_s[0], kDustFor_s[1]), 0.1), rounded(thick, 0.001), rounded(0.1 * thick, 0.001)});
  }
  return dust;
}

// It rains and dries: wetness 0 dry sandy clay as in the bench's scenario to 1, wet and sticky.
std::vector<DrawnSoil> draw_soil(double seconds, std::uint64_t seed) {
  Draw draw(seed, stream_soil);
  std::vector<DrawnSoil> changes;
  for (double t = draw.between(600.0, kSoilEvery_s[0]); t < seconds; t += draw.between(kSoilEvery_s[0], kSoilEvery_s[1])) {
    const double wet = draw.unit();
    changes.push_back({rounded(t, 1.0), rounded(36.0 + 6.0 * wet, 0.1), rounded(50.0 + 10.0 * wet, 0.1), rounded(0.5 + 0.1 * wet, 0.01), rounded(0.06 * wet, 0.001)});
  }
  return changes;
}

}  // namespace

DrawnShift draw_shift(double hours, std::uint64_t seed) {
  DrawnShift shift;
  shift.seconds = 3600.0 * hours;
  shift.seed = seed;
  shift.trucks = draw_trucks(seed);
  Draw people(seed, stream_people);
  for (int i = 0; i < kPeople; ++i) shift.people.push_back(draw_person(people, shift.seconds));
  shift.dust = draw_dust(shift.seconds, seed);
  shift.soil = draw_soil(shift.seconds, seed);
  return shift;
}

int trucks_enough(double hours) { return std::min(1000, 2 + static_cast<int>(3600.0 * hours / kShortestTruck_s)); }

constexpr const char* kDrawn = "# A shift of ";  // how the text of one begins

std::string scenario_text(const DrawnShift& shift) {
  constexpr double kFar = 19.0;  // m behind and to the right: where people wait
  // The bench is as long as the machine may move back in the time: seven or eight moves an hour were made, of 1 to 1.5 m, and more where each truck has its own.
  constexpr double kLeastBack_m = 84.0, kBack_m_h = 18.0, kBehind_m = 12.0;
  const double back = std::max(kLeastBack_m, kBack_m_h * shift.seconds / 3600.0);
  std::string out = fmt::format("{}{:.2f} h, drawn from seed {}. Format: FORMAT.md.\n", kDrawn, shift.seconds / 3600, shift.seed);
  const auto add = [&out]<typename... Values>(fmt::format_string<Values...> format, Values&&... values) { out += fmt::format(format, std::forward<Values>(values)...); };
  add("schema = 1\nname = \"soak\"\nmachine = \"zx200_ring\"\nsite = \"shift\"\nplant = \"zx200_ring_plant\"\n\n[run]\nmax_time_s = {:.1f}\noperator_run_from_s = 0.5\n\n", shift.seconds);
  add("[operator]\nreaction_s = [4.0, 12.0]\ntram_speed = 0.6\nfarthest_back_m = {:.1f}\nresets_after_s = [15.0, 60.0]\n\n", back);
  add("[start]\nswing_deg = 0.0\nboom_deg = 45.0\nstick_deg = -100.0\nbucket_deg = -100.0\n\n");
  add("[terrain]\nx = [{:.1f}, 16.0]\ny = [-16.0, 16.0]\ncell = 0.1\ncrest_x = 6.0\ntoe_x = 7.5\ncrest_y = 3.6\ntoe_y = 5.0\nlower_z = -2.2\nroughness = 0.02\n\n", -back - kBehind_m);
  add("[[dig_zone]]\nx = [3.9, 10.5]\ny = [-4.2, 4.2]\nfloor = -3.4\n\n");
  add("[soil]\ndensity_bank_kg_m3 = 1474.0\nswell = 1.10\nrepose_deg = 36.0\nbank_slope_deg = 50.0\nresistance = 0.5\nstick_fraction = 0.0\n\n");
  for (const DrawnSoil& s : shift.soil)
    add("[[soil_change]]\nat_s = {:.1f}\nrepose_deg = {:.1f}\nbank_slope_deg = {:.1f}\nresistance = {:.2f}\nstick_fraction = {:.3f}\n\n", s.at_s, s.repose_deg, s.bank_slope_deg, s.resistance, s.stick_fraction);
  for (const DrawnTruck& t : shift.trucks)
    add("[[truck]]\ncentre = [{:.2f}, {:.2f}]\nyaw_deg = {:.1f}\nlength = {:.2f}\nwidth = {:.2f}\nheight = {:.2f}\nwall_top = {:.2f}\nwall_thickness = 0.06\ncab_length = 2.2\ncab_gap = 0.3\n"
        "cab_top = 0.70\ntarget_kg = 18000.0\nwait_s = {:.1f}\napproach_m = 12.0\nspeed = 2.5\nplace_stddev = 0.03\nyaw_stddev_deg = 0.3\n\n",
        t.x, t.y, t.yaw_deg, t.length, t.width, t.height, t.wall_top, t.wait_s);
  int number = 0;
  for (const DrawnPerson& p : shift.people) {
    const double aside = 1.5 * number;
    add("[[person]]\nname = \"person_{}\"\nheight = {:.2f}\nradius = {:.2f}\nspeed = {:.2f}\nstart_s = 0.0\nbeside_machine = true\n", ++number, p.height, p.radius, p.speed);
    const auto point = [&](double x, double y, double wait_s) { add("[[person.waypoint]]\nat = [{:.2f}, {:.2f}]\nwait_s = {:.1f}\n", x, y, wait_s); };
    for (const DrawnVisit& v : p.visits) {
      point(-kFar - aside, -9.0, v.wait_s);
      point(v.way[0][0], v.way[0][1], v.enters ? 8.0 : 0.0);
      point(v.way[1][0], v.way[1][1], 0.0);
    }
    point(-kFar - aside, -9.0, 0.0);
    out += "\n";
  }
  for (const DrawnDust& d : shift.dust) add("[[dust]]\nat_s = {:.1f}\nfor_s = {:.1f}\nprobability = {:.3f}\nlost = {:.3f}\n\n", d.at_s, d.for_s, d.probability, d.lost);
  add("[scanner]\nsample_rate_hz = 12000.0\nsamples_per_revolution = 400\nrange = [0.3, 60.0]\nrange_stddev = 0.03\noutlier_probability = 0.001\ndropout_probability = 0.002\n"
      "dust_probability = 0.0005\nwindow_percent = 98.0\n");
  return out;
}

bool may_be_overwritten(const std::string& scenario) {
  std::ifstream file(scenario);
  std::string line;
  return !file || (std::getline(file, line) && line.starts_with(kDrawn));
}

}  // namespace berm::soak

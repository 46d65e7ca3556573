// What a scenario says of the world: plain values, checked by the scenario's loader. Base frame, metres, seconds, radians.
// The file format is fault_injection/scenarios/FORMAT.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace berm::plant {

// A ridge of bank soil over the segment from..to; its flanks fall off at slope.
struct MoundConfig {
  std::array<double, 2> from{}, to{};
  double top = 0.0;
  double slope = 0.0;
};

// Ground that was measured: heights at the centres of the terrain's cells, row by row, x fastest.
struct MeasuredGround {
  std::vector<double> height;
  double beyond = 0.0;                    // taken to be level outside the terrain: the rim's median height
};

// A bench of height 0 with a crest in front and one at the left; beyond each crest a plane falls to the lower ground. Or measured ground instead.
struct TerrainConfig {
  double x_low = -16.0, y_low = -16.0, x_high = 16.0, y_high = 16.0, cell = 0.1;
  double crest_x = 6.0, toe_x = 7.5;      // front slope: bench for x < crest_x, lower ground for x > toe_x
  double crest_y = 3.6, toe_y = 4.8;      // left slope
  double lower_z = -2.2;
  double roughness = 0.0;                 // standard deviation of the surface, seeded
  std::vector<MoundConfig> mounds;
  std::optional<MeasuredGround> measured;

  [[nodiscard]] int count_x() const { return cells(x_low, x_high); }
  [[nodiscard]] int count_y() const { return cells(y_low, y_high); }

 private:
  [[nodiscard]] int cells(double low, double high) const { return std::max(2, static_cast<int>(std::lround((high - low) / cell))); }
};

struct SoilConfig {
  double density_bank = 1474.0;           // kg/m3
  double swell = 1.10;                    // loose volume over bank volume
  double repose = 0.63;                   // steepest slope at which loose soil rests
  double bank_slope = 1.05;               // steepest slope at which cut bank stands
  double resistance = 0.5;                // 0 none .. 1 a full bucket's cut nearly stops the joints
  double stick_fraction = 0.0;            // share of the payload that stays in the bucket when dumped
};

// Rain or sun: from at_s on the soil stands and resists otherwise.
struct SoilChange { double at_s = 0.0, repose = 0.63, bank_slope = 1.05, resistance = 0.5, stick_fraction = 0.0; };

// A truck by the inside of its bed when parked. Truck i of a run uses entry i modulo the list's size.
struct TruckConfig {
  double x = 0.0, y = 0.0, yaw = 0.0;     // centre of the bed; yaw of the bed's long axis, which points to the cab
  double length = 0.0, width = 0.0, height = 0.0;  // inside; height from bed floor to wall top
  double wall_top = 0.0;                  // z of the wall tops
  double wall_thickness = 0.0;
  double cab_length = 0.0, cab_gap = 0.0, cab_top = 0.0;  // box ahead of the bed, as wide as the bed outside; top z
  double target_kg = 0.0;
  double wait_s = 0.0;                    // from start, or from the departure of the truck before, until it stands
  double approach_m = 0.0;                // it comes from, and leaves, this far along its yaw: arrives in reverse, leaves forward
  double speed = 0.0;                     // m/s
  double place_stddev = 0.0, yaw_stddev = 0.0;     // of where it comes to stand, seeded
};

struct WaypointConfig { double x = 0.0, y = 0.0, wait_s = 0.0; };

// A person (upright cylinder) or vehicle (box, long axis along its motion) that walks straight from waypoint to waypoint on the ground.
struct MoverConfig {
  std::string name;
  bool vehicle = false;
  double height = 0.0;
  double radius = 0.0;                    // person
  double length = 0.0, width = 0.0;       // vehicle
  double speed = 0.0;                     // m/s
  double start_s = 0.0;                   // leaves the first waypoint at this time ...
  std::optional<double> start_swing_above;  // ... and not before the swing angle first exceeds this at or after start_s
  std::vector<WaypointConfig> waypoints;  // stands at the first until it starts, at the last for ever
  bool beside_machine = false;            // its waypoints move along when the operator trams the machine
  double appears_s = 0.0;                 // is nowhere before: comes out of a place that no sensor sees. Not part of the file format
};

struct BoxConfig {                        // a fixed obstacle
  std::string name;
  double x = 0.0, y = 0.0, z_low = 0.0, z_high = 0.0, length = 0.0, width = 0.0, yaw = 0.0;
};

struct DigZoneConfig {                    // ground in here may be touched and dug, down to the floor; what falls here is not spilled
  double x_low = 3.9, y_low = -4.2, x_high = 10.5, y_high = 4.2, floor = -3.4;
};

enum class Ranging { last_pulse, trailing_edge };  // which edge of the last return a panning scanner ranges by

struct ScannerConfig {
  double sample_rate_hz = 12000.0;
  int samples_per_revolution = 400;
  double range_min = 0.3, range_max = 60.0;
  double range_stddev = 0.0;
  double outlier_probability = 0.0;       // a sample with a range drawn between range_min and the true range
  double dropout_probability = 0.0;       // a sample without return
  double dust_probability = 0.0;          // a sample with an additional, nearer echo
  double window_percent = 100.0;
  double waveform_share = 0.0;            // of the panning scanners' samples: echoes computed from the sampled return instead of drawn
  Ranging ranging = Ranging::last_pulse;  // of those
  double reflectivity = 0.3;              // of all that those meet: soil and rock 0.2 to 0.4 in the near infrared, snow and new paint more
};

struct SensorFault {                      // of a panning scanner, or of a lidar on the upper body, for a time
  std::size_t sensor = 0;
  bool silent = false;                    // sends nothing; else something lies on its window
  double at_s = 0.0, for_s = 0.0;
  // Over this part of the mirror's circle, or of the lidar's azimuth, low first; all of it unless given.
  std::array<double, 2> turn{0.0, 2 * std::numbers::pi};
  bool stalled = false;                   // of a lidar: its head stands, it goes on sending; nothing lies on its window
};

struct DustConfig {                       // in the air about every sensor, for a time
  double at_s = 0.0, for_s = 0.0;
  double probability = 0.0;               // of an additional, nearer echo
  double lost = 0.0;                      // of the target's echo not coming back, but the dust's alone
};

struct CloudConfig {                      // dust in a box of the world, for a time: what samples with a waveform look through
  double x = 0.0, y = 0.0, z_low = 0.0, z_high = 0.0, length = 0.0, width = 0.0, yaw = 0.0;
  double extinction = 0.0;                // 1/m, one way
  double at_s = 0.0, for_s = 0.0;
};

struct WorldConfig {
  double ballast_kg = 0.0;                // a test weight fixed in the bucket: weighs and takes room as soil would, and never falls out
  TerrainConfig terrain;
  SoilConfig soil;
  std::vector<SoilChange> soil_changes;   // in the order of time
  std::vector<TruckConfig> trucks;
  std::vector<MoverConfig> movers;        // people and vehicles
  std::vector<BoxConfig> boxes;
  std::vector<DigZoneConfig> dig_zones{DigZoneConfig{}};
  ScannerConfig scanner;
  std::vector<SensorFault> scanner_faults, lidar_faults;
  std::vector<DustConfig> dust;
  std::vector<CloudConfig> clouds;
};

}  // namespace berm::plant

// The world around the machine: ground and soil, trucks, people, what the scanners see of them, and the independent oracle.
// SI units, radians, base frame (implement_shape.hpp). Everything is a function of the configuration, the seed and the calls made.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scan/scan_packet.h"

namespace berm::plant {

struct JointState { std::array<double, 4> angle{}; std::array<double, 4> velocity{}; };  // swing, boom, stick, bucket; rad, rad/s
struct PanState { std::array<double, 2> angle{}; std::array<double, 2> velocity{}; };    // left, right; relative to the upper body

struct ImplementShape;  // machine/implement_shape.hpp
struct MoverConfig;
struct WorldConfig;     // process/world_config.hpp
struct SoilChange;
struct BasePose;        // world/base_pose.hpp

struct EdgeForce { double r_n = 0.0, z_n = 0.0; };  // of the soil on the bucket's cutting edge, outward and upward in the swing plane

struct DigForces {
  std::array<double, 4> resist_speed_factor{1.0, 1.0, 1.0, 1.0};  // 0..1: what the soil leaves of each joint's speed
  EdgeForce edge;
};

struct LidarPacket;
class SideThread;     // world/spinning_lidar.hpp

struct BedTruth { double x = 0.0, y = 0.0, yaw = 0.0, length = 0.0, width = 0.0, wall_top = 0.0; };  // inside, where it parks

struct Truth {
  double payload_kg = 0.0;
  std::vector<double> truck_load_kg;      // one for each truck of the run
  std::vector<BedTruth> truck_bed;        // as many
  double spilled_kg = 0.0;                // dug, and neither in a truck nor in the bucket nor back in the dig zone
  double dug_kg = 0.0;
  double load_centre_offset_m = 0.0, load_height_stddev_m = 0.0;  // of the current or last truck
};

// Where the soil is that was dug, kg.
struct SoilMasses {
  double bucket = 0.0;     // with the ballast, if any
  double in_trucks = 0.0;  // of the run, those that have left too
  double spilled = 0.0;    // as Truth::spilled_kg
};

struct OracleVerdict {
  bool contact = false;                   // of this step: the machine touches what it must not
  double closest_m = 0.0;                 // distance to the nearest person, vehicle, truck or box, 0 in contact; 1e9 when there is none
  double ground_gap_m = 0.0;              // least vertical gap over ground outside the dig zones (and over the zones' floor); negative: below it
  std::string what;                       // its name
  bool by_upper_body = false;             // it is the upper body that touches it, or is nearest to it, and no implement
};

// A return of a sensor that a person or vehicle sent back, not noise: its place among those of movers() that are no trucks, and where it was met.
struct MoverReturn { std::size_t mover = 0; double x = 0.0, y = 0.0, z = 0.0; };

struct MoverPose { std::string name; double x = 0.0, y = 0.0, z = 0.0, yaw = 0.0; bool vehicle = false; };

class World {
 public:
  World(const WorldConfig& config, const ImplementShape& shape, std::uint64_t seed, int trucks);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  // How the base stands from here on; as the scenario has it until told otherwise: level, at the origin.
  void stand(const BasePose& base);
  // From t - dt to t: moves people and trucks, cuts, carries, dumps, settles.
  DigForces step(double t, double dt, const JointState& now, const JointState& previous);
  // Samples of both scanners in (t - dt, t], appended as packets. 12 kHz, 400 a turn; at most 120 a packet; packets do not span scanlines.
  void scan(double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before, const PanState& pan_now,
            std::vector<berm_scan_packet>& out);
  // Firings of the lidars on the upper body in (t - dt, t], after scan() of the same step: it has gathered what there is to see.
  void scan_lidars(double t, double dt, const JointState& before, const JointState& now, std::vector<LidarPacket>& out);
  // Both in one, with the same results: shared with the side thread, if there is one.
  void sense(double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before, const PanState& pan_now,
             std::vector<berm_scan_packet>& scans, std::vector<LidarPacket>& lidars, SideThread* side);
  // Works out, in time that is to spare, what the lidars of the next sense() with a side thread will meet, if the joints move as told here; until all
  // is seen or it is enough. What comes of the step is the same, whatever has changed until then.
  void foresee(double t, double dt, const JointState& before, const JointState& now, const std::function<bool()>& enough);
  // Of people and vehicles, in the newest scan() and the scan_lidars() after it.
  const std::vector<MoverReturn>& mover_returns() const;
  OracleVerdict judge(double t, const JointState& joints);  // independent oracle
  double payload_kg() const;
  SoilMasses soil_masses() const;
  Truth truth() const;
  std::size_t trucks() const;
  std::vector<MoverPose> movers() const;  // the same names in the same order at every call: trucks first
  // Another takes the place of that person or vehicle: it appears at t and sets out, whatever its configuration says.
  void send_mover(std::size_t mover, const MoverConfig& config, double t);
  void draw_sensors_anew(uint64_t seed);  // what the sensors draw from now on
  bool mover_present(std::size_t mover) const;  // of people and vehicles: whether it is on the site yet
  void release_truck(double t);           // the horn: the full truck drives off, the next one comes if there is one
  // The machine is about to tram: the truck that is here makes way, and none comes before machine_stands.
  void make_way(double t);
  double dust(double t) const;            // in the air of all sensors: the share of samples that it meets
  bool truck_about() const;               // one stands or drives at the machine
  // The machine trammed by so much: dig zones and the places of the trucks to come are moved along with it, and the next truck is called.
  void machine_stands(double t, double x, double y);
  // Weather: from now on the ground, and what is poured into trucks, has this soil's slopes, resistance and stickiness; its densities are those it had.
  void change_soil(const SoilChange& change);
  bool truck_parked() const;
  bool truck_leaving() const;
  bool truck_makes_way() const;           // it leaves with what it has, and will be back
  bool all_trucks_done() const;
  // CSV grid: header line x0,y0,cell,nx,ny, then rows of heights; truck beds included as a second layer, file path + ".truck".
  void write_terrain(const std::string& path) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berm::plant

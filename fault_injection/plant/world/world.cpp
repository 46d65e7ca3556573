#include "plant/world/world.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "config/whole_file.hpp"
#include "plant/machine/implement_shape.hpp"
#include "plant/oracle/oracle.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/foresight.hpp"
#include "plant/world/link_frames.hpp"
#include "plant/world/landing.hpp"
#include "plant/world/movers.hpp"
#include "plant/world/random.hpp"
#include "plant/world/scanner.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/side_thread.hpp"
#include "plant/world/soil_cut.hpp"
#include "plant/world/spinning_lidar.hpp"
#include "plant/world/terrain.hpp"
#include "plant/world/truck.hpp"

namespace berm::plant {
namespace {

// Cells looked at in one step at most: what is still moving goes on in the next.
constexpr int ground_budget = 2000, bed_budget = 1000;

// Streams of their own for each use, so that a change to one leaves the others as they were.
enum Stream : uint64_t { stream_terrain = 1, stream_trucks = 2, stream_left = 3, stream_right = 4, stream_lidars = 5 };
uint64_t seed_of(uint64_t seed, Stream stream) {
  uint64_t x = seed * 0x9E3779B97F4A7C15u + stream * 0xD1B54A32D192ED03u;  // splitmix64's finaliser
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

std::vector<Truck> make_trucks(const WorldConfig& config, const Terrain& terrain, uint64_t seed, int count) {
  Random random(seed);
  std::vector<Truck> all;
  if (config.trucks.empty()) return all;
  for (int i = 0; i < count; ++i) {
    const TruckConfig& c = config.trucks[static_cast<size_t>(i) % config.trucks.size()];
    const double dx = c.place_stddev * random.normal(), dy = c.place_stddev * random.normal(), turn = c.yaw_stddev * random.normal();
    all.emplace_back(c, config.soil, "truck_" + std::to_string(i + 1), terrain.as_built(c.x, c.y), dx, dy, turn);
  }
  return all;
}

}  // namespace

struct World::State {
  State(const WorldConfig& c, const ImplementShape& s, uint64_t seed, int trucks)
      : config(c), shape(s), terrain(c.terrain, c.soil, seed_of(seed, stream_terrain)), truck(make_trucks(c, terrain, seed_of(seed, stream_trucks), trucks)),
        movers(c.movers), load(s, c.soil, c.ballast_kg), cut(s, c.soil), landing(terrain, truck, config.dig_zones), oracle(s),
        scanner{Scanner(c.scanner, s.scanner[0], 0, seed_of(seed, stream_left)), Scanner(c.scanner, s.scanner[1], 1, seed_of(seed, stream_right))} {
    for (size_t i = 0; i < s.lidar.size(); ++i) lidar.emplace_back(c.scanner, s.lidar[i], static_cast<uint8_t>(i), seed_of(seed, stream_lidars) + i);
    if (!truck.empty()) truck[0].call(0);
    move_trucks(0);
    movers.step(0, 0, 0, terrain);
  }

  void move_trucks(double t) {
    for (size_t i = 0; i < truck.size(); ++i) {
      over.clear();
      truck[i].step(t, bed_budget, over);
      for (const Overflow& o : over) landing.overflow(truck[i], o, book);
      if (truck[i].phase() == Truck::Phase::gone && current == i) {
        ++current;
        if (current < truck.size()) truck[current].call(truck[i].gone_at());
      }
    }
  }

  // Of sensor i of these at time t.
  [[nodiscard]] SensorAir air(const std::vector<SensorFault>& faults, size_t i, double t) const {
    const auto during = [t](const auto& span) { return t >= span.at_s && t < span.at_s + span.for_s; };
    SensorAir a;
    for (const DustConfig& d : config.dust) {
      if (!during(d)) continue;
      a.dust = d.probability;
      a.lost = d.lost;
    }
    for (const SensorFault& f : faults) {
      if (f.sensor != i || !during(f)) continue;
      (f.silent ? a.silent : f.stalled ? a.stalled : a.covered) = true;
      if (!f.silent && !f.stalled) a.turn = f.turn;
    }
    for (const CloudConfig& c : config.clouds) {
      if (!during(c)) continue;
      a.clouds.push_back({{PlanarFrame(c.x, c.y, 0, c.yaw), {-c.length / 2, -c.width / 2, c.z_low}, {c.length / 2, c.width / 2, c.z_high}}, c.extinction});
    }
    return a;
  }
  [[nodiscard]] double loose_density() const { return config.soil.density_bank / config.soil.swell; }
  // The truck that is here or expected; the last one when all are gone.
  [[nodiscard]] const Truck* shown() const { return truck.empty() ? nullptr : &truck[std::min(current, truck.size() - 1)]; }
  [[nodiscard]] oracle::Site site() const;
  void place(const JointState& now, Scene& in) const;
  void scan(size_t scanner, double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before, const PanState& pan_now,
            std::vector<berm_scan_packet>& out, std::vector<MoverReturn>& returns);
  void fire(size_t lidar, double t, double dt, const JointState& before, const JointState& now, std::vector<LidarPacket>& out,
            std::vector<MoverReturn>& returns);

  WorldConfig config;
  ImplementShape shape;
  Terrain terrain;
  std::vector<Truck> truck;
  Movers movers;
  BucketLoad load;
  SoilCut cut;
  Landing landing;
  SoilBook book;
  oracle::Oracle oracle;
  std::array<Scanner, 2> scanner;
  std::vector<SpinningLidar> lidar;
  Scene scene;
  BasePose base;
  Foresight foresight;
  std::vector<MoverReturn> mover_returns;
  struct Sensed {  // of one sensor in one step
    std::vector<berm_scan_packet> scans;
    std::vector<LidarPacket> lidars;
    std::vector<MoverReturn> returns;
    void clear() { scans.clear(), lidars.clear(), returns.clear(); }
  } scanned;                   // of the second scanner
  std::vector<Sensed> sensed;  // of each lidar
  size_t current = 0;
  std::vector<Overflow> over;
};

World::World(const WorldConfig& config, const ImplementShape& shape, std::uint64_t seed, int trucks)
    : state_(std::make_unique<State>(config, shape, seed, trucks)) {}
World::~World() = default;

void World::stand(const BasePose& base) { state_->base = base; }

DigForces World::step(double t, double dt, const JointState& now, const JointState& previous) {
  State& w = *state_;
  w.movers.step(t, dt, now.angle[0], w.terrain, w.base.x, w.base.y);
  w.move_trucks(t);
  const BucketPose before = w.cut.pose(link_frames(w.shape, previous), w.base), here = w.cut.pose(link_frames(w.shape, now), w.base);
  const double taken = w.cut.cut(before, here, dt, w.terrain, w.load, w.book);
  w.cut.empty(here, dt, w.terrain, w.load, w.landing, w.book);
  w.terrain.settle(ground_budget);
  DigForces forces;
  const double factor = w.cut.speed_factor(taken, dt);
  forces.resist_speed_factor.fill(factor);
  forces.edge = w.cut.edge_force(before, here, dt, factor);
  return forces;
}

void World::State::place(const JointState& now, Scene& in) const {
  in.place_site(terrain, truck, movers, config.boxes);
  in.place_machine(shape, link_frames(shape, now), std::max(0.0, load.volume() - load.struck()));
}

void World::State::scan(size_t i, double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before,
                        const PanState& pan_now, std::vector<berm_scan_packet>& out, std::vector<MoverReturn>& returns) {
  const SensorAir a = air(config.scanner_faults, i, t);
  const ScanPose from{before.angle[0], pan_before.angle[i]}, to{now.angle[0], pan_now.angle[i]};
  if (!a.silent) scanner[i].step(t, dt, from, to, scene, out, BaseFrame(base), &returns, a);
}

void World::State::fire(size_t i, double t, double dt, const JointState& before, const JointState& now, std::vector<LidarPacket>& out,
                        std::vector<MoverReturn>& returns) {
  const SensorAir a = air(config.lidar_faults, i, t);
  if (!a.silent) lidar[i].step({t, dt, before.angle[0], now.angle[0]}, a, scene, BaseFrame(base), out, &returns, foresight.hits(i));
}

void World::scan(double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before, const PanState& pan_now,
                 std::vector<berm_scan_packet>& out) {
  state_->mover_returns.clear();
  state_->foresight.forget();
  state_->place(now, state_->scene);
  for (size_t i = 0; i < state_->scanner.size(); ++i) state_->scan(i, t, dt, before, now, pan_before, pan_now, out, state_->mover_returns);
}

void World::scan_lidars(double t, double dt, const JointState& before, const JointState& now, std::vector<LidarPacket>& out) {
  for (size_t i = 0; i < state_->lidar.size(); ++i) state_->fire(i, t, dt, before, now, out, state_->mover_returns);
}

// Each scanner and lidar draws from its own stream, and the scene is only looked at.
void World::sense(double t, double dt, const JointState& before, const JointState& now, const PanState& pan_before, const PanState& pan_now,
                  std::vector<berm_scan_packet>& scans, std::vector<LidarPacket>& lidars, SideThread* side) {
  State& w = *state_;
  if (side == nullptr || w.lidar.size() < 2) {
    scan(t, dt, before, now, pan_before, pan_now, scans);
    scan_lidars(t, dt, before, now, lidars);
    return;
  }
  w.mover_returns.clear();
  w.place(now, w.scene);
  w.foresight.compare({t, dt, before.angle[0], now.angle[0]}, w.base, w.scene, w.lidar.size());
  w.sensed.resize(w.lidar.size());
  for (State::Sensed& of : w.sensed) of.clear();
  w.scanned.clear();
  std::atomic<bool> scans_second = false;
  std::atomic<size_t> next_lidar = 0;
  // What either thread takes of what none has begun; a lidar's returns are made when all rays of all lidars are known.
  const auto work = [&] {
    if (!scans_second.exchange(true)) w.scan(1, t, dt, before, now, pan_before, pan_now, w.scanned.scans, w.scanned.returns);
    w.foresight.complete(w.lidar, w.scene);
    while (!w.foresight.completed()) std::this_thread::yield();
    for (size_t i; (i = next_lidar.fetch_add(1)) < w.lidar.size();) w.fire(i, t, dt, before, now, w.sensed[i].lidars, w.sensed[i].returns);
  };
  side->give(work);
  w.scan(0, t, dt, before, now, pan_before, pan_now, scans, w.mover_returns);
  work();
  side->end();
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(scans, w.scanned.scans);
  append(w.mover_returns, w.scanned.returns);
  for (const State::Sensed& of : w.sensed) {
    append(lidars, of.lidars);
    append(w.mover_returns, of.returns);
  }
}

void World::foresee(double t, double dt, const JointState& before, const JointState& now, const std::function<bool()>& enough) {
  State& w = *state_;
  w.place(now, w.foresight.begin({t, dt, before.angle[0], now.angle[0]}, w.base, w.lidar.size()));
  w.foresight.look(w.lidar, enough);
}

oracle::Site World::State::site() const {
  oracle::Site s;
  for (const Truck& t : truck) {
    if (!t.present()) continue;
    const PlanarFrame& f = t.frame();
    for (const TruckPart& p : t.parts()) {
      s.blocks.push_back({t.name() + " " + p.name, f.x, f.y, f.z, t.yaw(), {p.low.x, p.low.y, p.low.z}, {p.high.x, p.high.y, p.high.z}});
    }
  }
  for (const BoxConfig& b : config.boxes) {
    s.blocks.push_back({b.name, b.x, b.y, 0, b.yaw, {-b.length / 2, -b.width / 2, b.z_low}, {b.length / 2, b.width / 2, b.z_high}});
  }
  for (size_t i = 0; i < movers.count(); ++i) {
    if (!movers.present(i)) continue;
    const MoverConfig& c = movers.config(i);
    const MoverPose& p = movers.pose(i);
    if (c.vehicle) s.blocks.push_back({c.name, p.x, p.y, p.z, p.yaw, {-c.length / 2, -c.width / 2, 0}, {c.length / 2, c.width / 2, c.height}});
    else s.people.push_back({c.name, p.x, p.y, p.z, c.radius, c.height});
  }
  for (const DigZoneConfig& z : config.dig_zones) s.zones.push_back({z.x_low, z.y_low, z.x_high, z.y_high, z.floor});
  const HeightGrid& g = terrain.grid();
  s.ground = {g.x_low(), g.y_low(), g.cell_x(), g.count_x(), g.count_y(), g.data()};
  return s;
}

OracleVerdict World::judge(double, const JointState& joints) {
  const BasePose& b = state_->base;
  const oracle::Judgement j = state_->oracle.judge(joints.angle, state_->site(), {b.x, b.y, b.yaw, b.roll, b.pitch});
  return {j.contact, j.closest, j.ground_gap, j.what, j.by_upper_body};
}

double World::payload_kg() const { return state_->load.volume() * state_->loose_density() + state_->config.ballast_kg; }

SoilMasses World::soil_masses() const {
  const State& w = *state_;
  return {payload_kg(), (w.book.dug - w.load.volume() - w.book.spilled) * w.loose_density(), w.book.spilled * w.loose_density()};
}

Truth World::truth() const {
  const State& w = *state_;
  Truth out;
  const SoilMasses soil = soil_masses();
  out.payload_kg = soil.bucket;
  for (const Truck& t : w.truck) {
    out.truck_load_kg.push_back(t.load_kg());
    out.truck_bed.push_back({t.parked_x() - t.shifted_x(), t.parked_y() - t.shifted_y(), t.yaw(), t.config().length, t.config().width, t.config().wall_top});
  }
  out.spilled_kg = soil.spilled;
  out.dug_kg = w.book.dug * w.loose_density();
  if (const Truck* t = w.shown()) {
    out.load_centre_offset_m = t->heap().centre_offset();
    out.load_height_stddev_m = t->heap().height_stddev();
  }
  return out;
}

std::size_t World::trucks() const { return state_->truck.size(); }

std::vector<MoverPose> World::movers() const {
  const State& w = *state_;
  std::vector<MoverPose> all;
  for (const Truck& t : w.truck) all.push_back({t.name(), t.frame().x, t.frame().y, t.frame().z, t.yaw(), true});
  for (size_t i = 0; i < w.movers.count(); ++i) all.push_back(w.movers.pose(i));
  return all;
}

void World::send_mover(std::size_t mover, const MoverConfig& config, double t) { state_->movers.send(mover, config, t); }

void World::draw_sensors_anew(uint64_t seed) {
  state_->scanner[0].draw_anew(seed_of(seed, stream_left));
  state_->scanner[1].draw_anew(seed_of(seed, stream_right));
  for (size_t i = 0; i < state_->lidar.size(); ++i) state_->lidar[i].draw_anew(seed_of(seed, stream_lidars) + i);
}

bool World::mover_present(std::size_t mover) const { return state_->movers.present(mover); }
const std::vector<MoverReturn>& World::mover_returns() const { return state_->mover_returns; }

void World::release_truck(double t) {
  if (state_->current < state_->truck.size()) state_->truck[state_->current].release(t);
}

void World::make_way(double t) {
  State& w = *state_;
  if (w.current < w.truck.size()) w.truck[w.current].make_way(t);
}

double World::dust(double t) const {
  const SensorAir air = state_->air({}, 0, t);
  return air.dust + air.lost;
}

bool World::truck_about() const { return std::any_of(state_->truck.begin(), state_->truck.end(), [](const Truck& t) { return t.present(); }); }

void World::machine_stands(double t, double x, double y) {
  State& w = *state_;
  for (DigZoneConfig& z : w.config.dig_zones) {
    z.x_low += x, z.x_high += x;
    z.y_low += y, z.y_high += y;
  }
  for (size_t i = w.current; i < w.truck.size(); ++i) w.truck[i].shift(x, y);
  if (w.current < w.truck.size()) w.truck[w.current].call(t);
}

void World::change_soil(const SoilChange& change) {
  State& w = *state_;
  SoilConfig& soil = w.config.soil;
  soil.repose = change.repose;
  soil.bank_slope = change.bank_slope;
  soil.resistance = change.resistance;
  soil.stick_fraction = change.stick_fraction;
  w.terrain.change_soil(soil);
  w.cut.change_soil(soil);
  w.load.change_soil(soil);
  for (Truck& truck : w.truck) truck.heap().rest_at(soil.repose);
}

bool World::truck_makes_way() const {
  const Truck* t = state_->shown();
  return t != nullptr && t->makes_way();
}

bool World::truck_parked() const {
  const Truck* t = state_->shown();
  return t != nullptr && t->phase() == Truck::Phase::parked;
}

bool World::truck_leaving() const {
  const Truck* t = state_->shown();
  return t != nullptr && t->phase() == Truck::Phase::leaving;
}

bool World::all_trucks_done() const { return !state_->truck.empty() && state_->current == state_->truck.size(); }

void World::write_terrain(const std::string& path) const {
  const State& w = *state_;
  const HeightGrid& g = w.terrain.grid();
  const auto write = [&](const std::string& file, auto height) {
    std::ostringstream out;
    out << std::setprecision(6) << g.x_low() << ',' << g.y_low() << ',' << g.cell_x() << ',' << g.count_x() << ',' << g.count_y() << '\n';
    out << std::fixed << std::setprecision(4);
    for (int iy = 0; iy < g.count_y(); ++iy) {
      for (int ix = 0; ix < g.count_x(); ++ix) {
        if (ix > 0) out << ',';
        const double z = height(ix, iy);
        if (std::isnan(z)) out << "nan";
        else out << z;
      }
      out << '\n';
    }
    config::write_whole_file(file, out.view());
  };
  write(path, [&](int ix, int iy) { return g.at(ix, iy); });
  write(path + ".truck", [&](int ix, int iy) {
    for (const Truck& t : w.truck) {
      if (!t.present()) continue;
      const Vec3 p = t.frame().in(Vec3{g.centre_x(ix), g.centre_y(iy), 0});
      if (t.over_bed(p)) return t.frame().z + t.heap().grid().surface(p.x, p.y);
    }
    return std::numeric_limits<double>::quiet_NaN();
  });
}

}  // namespace berm::plant

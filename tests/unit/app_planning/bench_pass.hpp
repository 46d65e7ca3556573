// A bench with a truck beside it, and a pass over it, with what may be heaped up on the way.
#pragma once

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "planning/pass_search.hpp"
#include "planning/skyline.hpp"

namespace berm::app_bench {

struct Heap { double bearing = 0.0, distance = 6.0, radius = 0.5, top = -10.0; };  // flat

struct BenchPass {
  BenchPass() : machine(zx200()), site(bench_with_truck()), scripts(shipped_scripts()) {
    for (double x = -12.0; x < 12.0; x += 0.1)
      for (double y = -12.0; y < 12.0; y += 0.1) terrain.insert(x, y, x < 6.0 && y < 3.6 ? 0.0 : -2.2, 1.0);
    task.lifted_from = *app::inverse_tip(machine, {5.6, 0.4}, app::radians(-170.0), app::radians(7.0));
    task.truck_bearing = app::radians(96.0);
    task.dump_radius = 6.8;
    task.next_bearing = 0.0;
    task.next_entry = {7.4, -1.6};
    task.truck_top = task.wall_top = bench_bed().wall_top;
  }
  app::PassSearch begin(const app::PassPoses& poses) const { return app::PassSearch(scripts, machine, app::Skyline(machine, site, app::ground_of(terrain)), task, poses); }
  // As the map has it, with a heap on it.
  app::Skyline skyline(const Heap& heap = {}) const {
    const double x0 = heap.distance * std::cos(heap.bearing), y0 = heap.distance * std::sin(heap.bearing);
    return app::Skyline(machine, site, [&](double x, double y) {
      const double ground = terrain.height_or(x, y, 0.0);
      return std::hypot(x - x0, y - y0) < heap.radius ? std::max(ground, heap.top) : ground;
    });
  }

  app::MachineModel machine;
  app::SiteModel site;
  app::ScriptSet scripts;
  app::TerrainMap terrain;
  app::PassTask task;
};

}  // namespace berm::app_bench

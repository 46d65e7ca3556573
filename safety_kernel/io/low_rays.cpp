#include "io/low_rays.hpp"

#include <algorithm>
#include <cstdlib>

#include "io/along.hpp"

namespace berm::kernel {

namespace {

constexpr std::int32_t kStepMm = SK_CELL_MM / 4;                  // so that a ray that cuts a corner off is seen to
constexpr std::int64_t kStepsMost = 240;                          // before what is met: 18 m
constexpr std::int64_t kFirstStep = SK_CELL_MM / kStepMm;         // a cell before it: the thing itself is not passed
constexpr std::int32_t kWithinBinMm = SK_HISTOGRAM_BIN_MM / 2;    // a rise counts from the low side of a bin: the ground is half of it higher on average

void pass_cell(MonitorWatch& own, const MonitorWatch::Others& others, SpaceWatch* space, const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us) {
  if (!sk_is_in_map(at.iy, at.ix)) return;
  const bool foreign = space != nullptr && space->space().foreign[at.iy][at.ix] > 0;
  const bool another = std::any_of(others.monitor, others.monitor + others.count, [&at](const MonitorWatch* m) { return m->somebody(at); });
  if (!foreign && !another && !own.somebody(at)) return;
  if (!own.pass(at, z_mm, now_us, others)) return;
  for (int i = 0; i < others.count; ++i) others.monitor[i]->pass_of_another(at, z_mm, now_us, own);
  if (foreign) space->pass_low(at, z_mm, now_us);
}

}  // namespace

// From what is met towards the head, so the ray rises; in a cell it is no higher than where it has left it.
void pass_low(MonitorWatch& own, const MonitorWatch::Others& others, SpaceWatch* space, const sk_point& head, const sk_point& met, std::int64_t now_us) {
  if (own.histogram() == nullptr || head.z_mm <= met.z_mm) return;
  const std::int64_t dx = std::int64_t{head.x_mm} - met.x_mm, dy = std::int64_t{head.y_mm} - met.y_mm, dz = std::int64_t{head.z_mm} - met.z_mm;
  const std::int64_t steps = std::max(std::abs(dx), std::abs(dy)) / kStepMm;
  Along x(met.x_mm, dx, steps), y(met.y_mm, dy, steps), z(met.z_mm, dz, steps);
  sk_monitor_cell in{-1, -1};
  for (std::int64_t k = 1; k < std::min(steps, kStepsMost); ++k) {
    const std::int32_t x_mm = x.next(), y_mm = y.next(), z_mm = z.next();
    const sk_monitor_cell now_in{sk_map_index(y_mm), sk_map_index(x_mm)};
    if (k < kFirstStep || (now_in.iy == in.iy && now_in.ix == in.ix)) continue;
    pass_cell(own, others, space, in, z_mm - kWithinBinMm, now_us);
    in = now_in;
  }
}

}  // namespace berm::kernel

#include "planning/dump_point.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/bed_templates.hpp"
#include "planning/heap_top.hpp"

namespace berm::app {

namespace {

constexpr double enough_seen = 0.25;     // share of the cells; with less the books know more
constexpr double smoothing = 0.20;       // m, of the Gaussian
constexpr double wall_guard = 0.25;      // of the end walls
constexpr double side_guard = 0.05;      // of the side walls: the recogniser's deviation across the bed
// Half the bucket; how far its tip leans out beyond the point, and the swing's way to a stop.
double zone_guard(const ImplementScale& scale) { return 0.6 * scale.width + 0.9 * scale.arm; }
constexpr double pour_reach = 1.05;      // m from the dump point, by the bucket's scale: a heaped bucket's first soil towards the machine, its last soil and what rolls on beyond
constexpr double most_away = 0.15;       // m from the middle line, away from the machine, in a bed that is narrower than that
constexpr double hole_price = 0.5, slope_price = 0.1;
constexpr double beyond_price = 0.3;     // m of height for a metre that the soil has to run
constexpr double offset_limit = 0.07;    // m: what of the load's centre's offset is of no account
constexpr double offset_price = 5.0;     // m of height for a metre of offset
// m from the truck zone's ceiling: a heap that comes nearer is avoided, for forecasts came out up to 0.19 m too low; where none stays so low, the lowest is taken, down to the least.
constexpr double under_ceiling = 0.2, least_under_ceiling = 0.1;
constexpr double swing_price = 3.0;      // m of height for a radian beyond the bed's middle after a dig that lies a radian beyond the digs' middle: far digs go to the near end ...
constexpr double swing_passes = 2.0;     // ... the less, the fewer passes are left to bring the balance back; with so many half as much
constexpr double over_walls_price = 0.003;  // m of height for a kilogram that would fall over the walls
constexpr double part_price = 0.25, part_room = 2.2;  // m of height for a metre that a part is poured nearer to the truck zone's end than this, m: beyond it the cab holds the arm up
constexpr double middle_price = 0.02;    // m of height for a metre from the middle: of equal cells the one nearest to it

double bearing_of(const TruckBed& bed, const BedPoint& p) {
  double x = 0.0, y = 0.0;
  from_bed(bed, p, x, y);
  return std::atan2(y, x);
}

double radius_of(const TruckBed& bed, const BedPoint& p) {
  double x = 0.0, y = 0.0;
  from_bed(bed, p, x, y);
  return std::hypot(x, y);
}

// How far to either side of the bed's middle line the bucket may pour: its way over the bed as it pours, and its width where the bed stands aslant.
// Negative in a bed that is too narrow for it.
double room_across(const TruckBed& bed, double bucket_half_width, const ImplementScale& scale, double u) {
  const double turned = bearing_of(bed, {u, 0.0}) - bed.yaw;
  return 0.5 * bed.width - pour_reach * scale.bucket * std::fabs(std::sin(turned)) - bucket_half_width * std::fabs(std::cos(turned)) - side_guard;
}

// As near to the place as the bucket may come.
BedPoint nearest(const TruckBed& bed, const BedArea& area, const DumpNeeds& needs, const BedPoint& place) {
  constexpr double step = 0.05;
  BedPoint p{std::clamp(place.u, area.u_low, area.u_high), 0.0};
  for (;;) {
    const double room = room_across(bed, needs.bucket_half_width, needs.scale, p.u);
    // Away from the machine a pour reaches less far: what is too narrow for it is made up for there.
    const double away = std::sin(bearing_of(bed, {p.u, 0.0}) - bed.yaw) > 0.0 ? 1.0 : -1.0;
    p.v = room >= 0.0 ? std::clamp(place.v, -room, room) : away * std::fmin(-room, most_away);
    // Out of the arm's reach: nearer to the bed's middle.
    if (radius_of(bed, p) <= needs.farthest_radius || std::fabs(p.u) < step) return p;
    p.u -= std::copysign(step, p.u);
  }
}

// How far towards the machine the middle of a bucket of this much falls from where it is poured.
double inward(double kg, const ImplementScale& scale) {
  constexpr double even_kg = 1300.0, per_kg = 0.00045, most_inward = 0.11, most_outward = 0.35;
  return scale.bucket * std::clamp(per_kg * (kg / scale.load - even_kg), -most_outward, most_inward);
}

BedPoint moved_inward(const TruckBed& bed, const BedPoint& p, double distance) {
  double x = 0.0, y = 0.0;
  from_bed(bed, p, x, y);
  const double share = 1.0 - distance / std::hypot(x, y);
  return to_bed(bed, x * share, y * share);
}

// By the books, its centre moved towards that of what is seen as much as is seen.
LoadMoment load_of(const BedMap& bed, const BedGrid& heights, double seen_share) {
  LoadMoment seen;
  for (int row = 0; row < heights.rows; ++row)
    for (int column = 0; column < heights.columns; ++column) seen.add({heights.u(column), heights.v(row)}, heights.height[heights.index(column, row)]);
  LoadMoment load = bed.noted_load();
  const BedPoint by_sight = seen.centre();
  load.u_kgm += seen_share * (load.kg * by_sight.u - load.u_kgm);
  load.v_kgm += seen_share * (load.kg * by_sight.v - load.v_kgm);
  return load;
}

// With a bucket that has come as full as it may, as those of small goals often do: then less is left to bring the load's centre back.
double least_offset_when_full(const TruckBed& bed, const BedArea& area, const DumpNeeds& needs, LoadMoment load, const BedPoint& at) {
  if (!std::isfinite(needs.most_kg) || needs.most_kg <= needs.dump_kg) return 0.0;
  load.add(landing(bed, at, needs.most_kg, needs.scale), needs.most_kg);
  return least_final_offset(load, std::fmax(0.0, needs.rest_kg - (needs.most_kg - needs.dump_kg)), area);
}

// Where heaps would come to stand under the truck zone's ceiling. Places in one column of cells count as one: across the bed there is little room.
class HeapForecast {
public:
  HeapForecast(const BedMap& map, const BedGrid& seen, const DumpNeeds& needs)
      : bed_(map.bed()), needs_(needs), heights_(filled_nearby(seen, map.noted())), soil_(heaped_soil(seen, heights_, map.noted_load().kg)),
        ceiling_(bed_.ceiling - (bed_.wall_top - bed_.height)), tops_(static_cast<std::size_t>(heights_.columns), -1.0), falls_(tops_),
        walls_(heights_, bed_.height, soil_.density, needs_.scale) {}

  const OverWalls& over_walls() const { return walls_; }
  // kg, that would fall over the walls.
  double falls(const BedPoint& at) {
    double& kg = falls_[static_cast<std::size_t>(heights_.column_of(at.u))];
    if (kg < 0.0) kg = walls_.falls(landing(bed_, at, needs_.dump_kg, needs_.scale), needs_.dump_kg);
    return kg;
  }
  bool well_under(double top) const { return top <= ceiling_ - under_ceiling; }
  bool fits(double top) const { return top <= ceiling_ - least_under_ceiling; }
  double top(const BedPoint& at) {
    double& top = tops_[static_cast<std::size_t>(heights_.column_of(at.u))];
    if (top < 0.0) top = top_after(heights_, landing(bed_, at, needs_.dump_kg, needs_.scale), needs_.dump_kg, soil_, needs_.scale);
    return top;
  }

private:
  const TruckBed& bed_;
  const DumpNeeds& needs_;
  BedGrid heights_;          // not smoothed: that would lower a heap's top
  HeapedSoil soil_;
  double ceiling_;           // over the floor
  std::vector<double> tops_, falls_;  // by column; negative: not asked for yet
  OverWalls walls_;
};

}  // namespace

BedArea dump_area(const TruckBed& bed, double bucket_half_width, const ImplementScale& scale) {
  const double from_zone = zone_guard(scale);
  const double farthest = std::fmax(0.0, 0.5 * bed.length - bucket_half_width - wall_guard - 2.0 * bed.end_deviation);
  const double room = std::fmax(0.0, room_across(bed, bucket_half_width, scale, 0.0));
  return {std::fmin(0.0, std::fmax(-farthest, bed.zone_low + from_zone)), std::fmax(0.0, std::fmin(farthest, bed.zone_high - from_zone)), -room, room};
}

BedPoint landing(const TruckBed& bed, const BedPoint& at, double kg, const ImplementScale& scale) {
  return moved_inward(bed, at, inward(kg, scale));
}

DumpPoint choose_dump_point(const BedMap& map, const DumpNeeds& needs) {
  const TruckBed& bed = map.bed();
  const BedGrid seen = map.seen(needs.since_s);
  DumpPoint point;
  point.seen_share = seen.known_share();
  point.observed = point.seen_share >= enough_seen;
  const BedGrid load_heights = point.observed ? filled(smoothed(seen, smoothing), smoothed(map.noted(), smoothing)) : smoothed(map.noted(), smoothing);
  const LoadMoment load = load_of(map, load_heights, point.observed ? point.seen_share : 0.0);
  const BedArea area = dump_area(bed, needs.bucket_half_width, needs.scale);
  const std::vector<double> height = convolved(load_heights, constant_template()), hole = convolved(load_heights, hole_template()),
                            along = convolved(load_heights, slope_template(true)), over = convolved(load_heights, slope_template(false));
  const double middle = bearing_of(bed, {});
  const double far_price = swing_price * needs.dig_beyond * needs.rest_kg / (needs.rest_kg + swing_passes * std::fmax(1.0, needs.dump_kg));
  // Poured short of its place where it is sure to fall beyond.
  const double lead = std::fmax(0.0, -inward(needs.most_kg, needs.scale));
  struct Candidate { BedPoint at; double price = 0.0; BedPoint load_centre; };
  std::vector<Candidate> candidates;
  candidates.reserve(height.size());
  for (int row = 0; row < load_heights.rows; ++row)
    for (int column = 0; column < load_heights.columns; ++column) {
      const std::size_t i = load_heights.index(column, row);
      const BedPoint cell{load_heights.u(column), load_heights.v(row)}, under = nearest(bed, area, needs, cell), at = moved_inward(bed, under, lead);
      LoadMoment with = load;
      with.add(landing(bed, at, needs.dump_kg, needs.scale), needs.dump_kg);
      const double least = std::fmax(least_final_offset(with, needs.rest_kg, area), least_offset_when_full(bed, area, needs, load, at));
      const double offset = std::fmax(0.0, least - offset_limit);
      const double price = height[i] - hole_price * hole[i] + slope_price * std::hypot(along[i], over[i]) + beyond_price * std::hypot(under.u - cell.u, under.v - cell.v) +
                           offset_price * offset + middle_price * std::hypot(under.u, under.v) + far_price * wrapped(bearing_of(bed, under) - middle) +
                           (needs.may_be_part ? part_price * std::fmax(0.0, part_room - std::fmin(bed.zone_high - under.u, under.u - bed.zone_low)) : 0.0);
      candidates.push_back({at, price, with.centre()});
    }
  const auto cheaper = [](const Candidate& a, const Candidate& b) { return a.price < b.price; };
  std::stable_sort(candidates.begin(), candidates.end(), cheaper);
  const Candidate* chosen = &candidates.front();
  if (point.observed) {
    HeapForecast forecast(map, seen, needs);
    if (forecast.falls(candidates.front().at) > 0.0) {
      for (Candidate& candidate : candidates) candidate.price += over_walls_price * forecast.falls(candidate.at);
      std::stable_sort(candidates.begin(), candidates.end(), cheaper);
    }
    point.over_walls = forecast.over_walls();
    if (std::isfinite(bed.ceiling)) {
      double lowest = std::numeric_limits<double>::infinity();
      for (const Candidate& candidate : candidates) {
        const double top = forecast.top(candidate.at);
        if (top >= lowest) continue;
        lowest = top;
        chosen = &candidate;
        if (forecast.well_under(top)) break;
      }
      point.heap_top = lowest;
      point.fits = forecast.fits(lowest);
    }
  }
  point.at = chosen->at;
  point.height = score(load_heights, constant_template(), load_heights.column_of(point.at.u), load_heights.row_of(point.at.v));
  point.load_centre = chosen->load_centre;
  point.bearing = bearing_of(bed, point.at);
  point.radius = radius_of(bed, point.at);
  return point;
}

}  // namespace berm::app

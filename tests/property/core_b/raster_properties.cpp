// Segments anywhere over a map with a past. A failure prints its seed (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/scanline_raster.h"
#include "draw.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::int64_t kNow = 50'000'000;
constexpr std::int32_t kGeneration = 1'000'000;
constexpr int kSamples = 5040;  // of a segment; a number with many divisors, so that samples fall on cell borders

// Never observed, of an old sweep, of this one; low and high.
void map_with_a_past(sk_height_map& map, std::uint32_t random) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      random = random * 1664525u + 1013904223u;
      const std::int32_t height = static_cast<std::int32_t>(random >> 8 & 0x1FFF) - 4096;
      const std::int64_t began = kNow - kGeneration + 1 - static_cast<std::int64_t>(random >> 24 & 1);
      if ((random >> 25 & 3) == 0) put(map, iy, ix, {SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM, 0, -1});
      else put(map, iy, ix, {height, static_cast<std::int32_t>(random >> 10 & 0xFFF), began, began + 10});
    }
}

// Anywhere, or on the borders of cells and of the map; mostly over the map.
std::int32_t coordinate(int kind) {
  switch (kind) {
    case 0: return draw(-32000, 32000);
    case 1: return 300 * draw(-52, 52);
    case 2: return 300 * draw(-53, 53) + draw(-1, 1);
    default: return draw(-15600, 15600);
  }
}

sk_point point() {
  return {coordinate(draw(0, 3)), coordinate(draw(0, 3)), chance(10) ? (chance(50) ? 20000 : -20000) : draw(-6000, 6000)};
}

struct Segment {
  sk_point p, q;
};

Segment segment() {
  Segment s{point(), point()};
  switch (draw(0, 6)) {
    case 0: s.q.x_mm = s.p.x_mm; break;  // along an axis
    case 1: s.q.y_mm = s.p.y_mm; break;
    case 2: s.q.x_mm = s.p.x_mm; s.q.y_mm = s.p.y_mm; break;
    case 3: s.q.x_mm = std::clamp(s.p.x_mm + draw(-700, 700), -32000, 32000); s.q.y_mm = std::clamp(s.p.y_mm + draw(-700, 700), -32000, 32000); break;
    case 4: s.q.z_mm = s.p.z_mm; break;
    default: break;
  }
  return s;
}

bool holds(int index, std::int64_t scaled) {  // a coordinate times kSamples in a closed cell
  return kSamples * low_of_cell_mm(index) <= scaled && scaled <= kSamples * low_of_cell_mm(index + 1);
}

int index_of(std::int64_t scaled) { return static_cast<int>((scaled + std::int64_t{15600} * kSamples) / (std::int64_t{300} * kSamples)); }

// Each sample in each closed cell that holds it.
void expect_samples_covered(const sk_height_map& map, const Segment& s) {
  for (int k = 0; k <= kSamples; ++k) {
    const auto at = [&](std::int64_t from, std::int64_t to) { return from * (kSamples - k) + to * k; };
    const std::int64_t x = at(s.p.x_mm, s.q.x_mm), y = at(s.p.y_mm, s.q.y_mm), z = at(s.p.z_mm, s.q.z_mm);
    const int iy_near = index_of(y), ix_near = index_of(x);
    for (int iy = std::max(iy_near - 1, 0); iy <= std::min(iy_near + 1, 103); ++iy)
      for (int ix = std::max(ix_near - 1, 0); ix <= std::min(ix_near + 1, 103); ++ix) {
        if (!holds(iy, y) || !holds(ix, x)) continue;
        RC_ASSERT(map.seen_us[iy][ix] == kNow);
        RC_ASSERT(std::int64_t{map.height_mm[iy][ix]} * kSamples >= z);
      }
  }
}

bool meets(int index, std::int32_t a, std::int32_t b) {
  return low_of_cell_mm(index) <= std::max(a, b) && std::min(a, b) <= low_of_cell_mm(index + 1);
}

// What an insertion of some height between the ends makes of a cell.
void expect_raised(const Cell& before, const Cell& after, const Segment& s) {
  const std::int32_t least = std::min(s.p.z_mm, s.q.z_mm), most = std::max(s.p.z_mm, s.q.z_mm);
  RC_ASSERT(after.seen_us == kNow);
  if (before.seen_us < 0) {
    RC_ASSERT(after.height_mm >= least && after.height_mm <= most && after.previous_mm == after.height_mm && after.began_us == kNow);
  } else if (before.began_us <= kNow - kGeneration) {
    RC_ASSERT(after.height_mm >= least && after.height_mm <= most && after.previous_mm == before.height_mm && after.began_us == kNow);
  } else {
    RC_ASSERT(after.height_mm == before.height_mm || (after.height_mm > before.height_mm && after.height_mm <= most));
    RC_ASSERT(after.height_mm >= least && after.previous_mm == before.previous_mm && after.began_us == before.began_us);
  }
}

// Each cell is untouched, or in the bounding rectangle and raised; the result counts the latter.
void expect_only_raised(const sk_height_map& before, const sk_height_map& after, const Segment& s, std::int32_t count) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const Cell was = cell_of(before, iy, ix), is = cell_of(after, iy, ix);
      if (was == is) continue;
      --count;
      RC_ASSERT(meets(ix, s.p.x_mm, s.q.x_mm) && meets(iy, s.p.y_mm, s.q.y_mm));
      expect_raised(was, is, s);
    }
  RC_ASSERT(count == 0);
}

}  // namespace

// verifies: SK-RS-2, SK-RS-3, SK-RS-4, SK-RS-6, SK-RS-9
TEST(RasterProperties, CoversTheSegmentAndNothingElse) {
  const auto before = std::make_unique<sk_height_map>(), after = std::make_unique<sk_height_map>();
  EXPECT_TRUE(rc::check("every sample is covered, and only cells of the rectangle are raised", [&] {
    map_with_a_past(*before, draw<std::uint32_t>(0, 1u << 30));
    for (int i = 0; i < 12; ++i) {
      const Segment s = segment();
      *after = *before;
      const std::int32_t count = sk_raster_segment(after.get(), &s.p, &s.q, kNow, kGeneration);
      RC_ASSERT(count >= 0);
      expect_samples_covered(*after, s);
      expect_only_raised(*before, *after, s, count);
    }
  }));
}

// verifies: SK-RS-7
TEST(RasterProperties, TheSameFromEitherEnd) {
  const auto forth = std::make_unique<sk_height_map>(), back = std::make_unique<sk_height_map>();
  EXPECT_TRUE(rc::check("turning a segment round changes nothing", [&] {
    map_with_a_past(*forth, draw<std::uint32_t>(0, 1u << 30));
    *back = *forth;
    const Segment s = segment();
    const std::int32_t count = sk_raster_segment(forth.get(), &s.p, &s.q, kNow, kGeneration);
    RC_ASSERT(count == sk_raster_segment(back.get(), &s.q, &s.p, kNow, kGeneration));
    RC_ASSERT(same(*forth, *back));
  }));
}

// verifies: SK-RS-1
TEST(RasterProperties, RefusesExactlyWhatIsOutOfRange) {
  const auto before = std::make_unique<sk_height_map>(), after = std::make_unique<sk_height_map>();
  EXPECT_TRUE(rc::check("refused if and only if out of range, and then unchanged", [&] {
    map_with_a_past(*before, draw<std::uint32_t>(0, 1u << 30));
    *after = *before;
    Segment s{point(), point()};
    std::int32_t* const figure[] = {&s.p.x_mm, &s.p.y_mm, &s.p.z_mm, &s.q.x_mm, &s.q.y_mm, &s.q.z_mm};
    for (std::int32_t* f : figure) {
      if (chance(10)) *f = chance(50) ? draw<std::int32_t>(-40000, 40000) : *rc::gen::arbitrary<std::int32_t>();
    }
    const std::int64_t now_us = chance(10) ? -draw<std::int64_t>(1, 1'000'000'000) : kNow;
    const std::int32_t generation_us = chance(10) ? -draw(0, 1'000'000) : kGeneration;
    bool good = now_us >= 0 && generation_us > 0;
    for (int i = 0; i < 6; ++i) {
      const std::int64_t most = i % 3 == 2 ? 20000 : 32000;
      good = good && *figure[i] <= most && -std::int64_t{*figure[i]} <= most;
    }
    const std::int32_t count = sk_raster_segment(after.get(), &s.p, &s.q, now_us, generation_us);
    RC_ASSERT((count >= 0) == good);
    if (!good) RC_ASSERT(count == -1 && same(*before, *after));
  }));
}

}  // namespace berm::core_test

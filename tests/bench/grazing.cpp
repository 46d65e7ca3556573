#include "grazing.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>

#include "column_mesh.hpp"
#include "convex_body.hpp"
#include "geometry/separation.hpp"
#include "pass_over.hpp"
#include "peer_bullet.hpp"
#include "peer_fcl.hpp"

namespace berm::bench {

namespace {

constexpr int kCases = 100;
constexpr std::int64_t kNowUs = 1000000;
constexpr std::int32_t kGroundMm = -6000;

// Normal n = (a, a + 1, c) up to the signs of x and y, so that (-1, 1, 0) with the same signs goes away from the column by 1 / |n| mm.
struct Case {
  std::int32_t n[3], corner[3], iy, ix;
};

Case draw(std::mt19937& random) {
  const auto between = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Case c{};
  const int a = between(150, 600), sign_x = between(0, 1) * 2 - 1, sign_y = between(0, 1) * 2 - 1;
  c.n[0] = sign_x * a;
  c.n[1] = sign_y * (a + 1);
  c.n[2] = between(300, 900);
  c.iy = SK_MAP_CELLS / 2 + between(2, 7);
  c.ix = SK_MAP_CELLS / 2 + between(2, 7);
  c.corner[0] = SK_MAP_ORIGIN_MM + (c.ix + (sign_x > 0 ? 1 : 0)) * SK_CELL_MM;
  c.corner[1] = SK_MAP_ORIGIN_MM + (c.iy + (sign_y > 0 ? 1 : 0)) * SK_CELL_MM;
  c.corner[2] = between(-500, 1500);
  return c;
}

// The face through the corner, moved by `steps` of 1 / |n| mm and by whole millimetres upward; the block stands on it.
sk_slice block(const Case& c, int steps, int up_mm) {
  const std::int32_t u[3] = {c.n[1], -c.n[0], 0}, v[3] = {c.n[2], 0, -c.n[0]};
  const std::int32_t away[3] = {c.n[0] > 0 ? -steps : steps, c.n[1] > 0 ? steps : -steps, up_mm};
  sk_slice slice{};
  slice.link = 3;
  slice.vertices = 8;
  const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) slice.xyz_mm[k][i] = c.corner[k] + away[k] + around[i % 4][0] * u[k] + around[i % 4][1] * v[k] + (i < 4 ? c.n[k] : 0);
  slice.planes = 1;
  slice.plane[0] = {0, 0, 1, *std::min_element(slice.xyz_mm[2], slice.xyz_mm[2] + 8) - 1};
  return slice;
}

// The two faces must run counter-clockwise from outside for FCL: the upper (first) one as seen against the normal.
ConvexBody turned(const sk_slice& slice, const Case& c) {
  ConvexBody body = body_of(slice);
  const auto edge = [&](int i, int j) { return Vec3{body.corner[j].x - body.corner[i].x, body.corner[j].y - body.corner[i].y, body.corner[j].z - body.corner[i].z}; };
  const Vec3 p = edge(0, 1), q = edge(1, 2);
  const double along = (p.y * q.z - p.z * q.y) * c.n[0] + (p.z * q.x - p.x * q.z) * c.n[1] + (p.x * q.y - p.y * q.x) * c.n[2];
  if (along > 0)  // faces() wants the first outline clockwise
    for (int k = 0; k < 8; k += 4) std::reverse(body.corner.begin() + k, body.corner.begin() + k + 4);
  return body;
}

class Question {
 public:
  explicit Question(const Case& c) : case_(c), heights_(SK_MAP_CELLS * SK_MAP_CELLS, kGroundMm), map_(new sk_height_map), columns_(new sk_columns), choice_(new sk_choice) {
    heights_[c.iy * SK_MAP_CELLS + c.ix] = c.corner[2];
    sk_map_clear(map_.get());
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) sk_map_insert(map_.get(), iy, ix, heights_[iy * SK_MAP_CELLS + ix], kNowUs, 1000000);
    rules_.now_us = kNowUs;
    rules_.fresh_us = 1000000;
    test::pass_over(rules_);
    sk_columns_of(map_.get(), &rules_, columns_.get());
    std::vector<std::int32_t> patch(9, kGroundMm);
    patch[4] = c.corner[2];
    Mesh mesh = column_mesh(patch, 3, SK_CELL_MM);
    for (Vec3& v : mesh.vertex) {
      v.x += (SK_MAP_ORIGIN_MM + (c.ix + 0.5) * SK_CELL_MM) * 1e-3;
      v.y += (SK_MAP_ORIGIN_MM + (c.iy + 0.5) * SK_CELL_MM) * 1e-3;
    }
    fcl_ = std::make_unique<FclMap>(mesh);
    bullet_ = std::make_unique<BulletMap>(mesh, -1.0);
    bare_ = std::make_unique<BulletMap>(mesh, 0.0);
  }

  void ask(int steps, int up_mm, GrazingRow& row) {
    sk_slice slice = block(case_, steps, up_mm);
    const ConvexBody body = turned(slice, case_);
    kernel::PlaneCandidates candidates{};
    candidates.count = 1;
    candidates.nx[0] = case_.n[0];
    candidates.ny[0] = case_.n[1];
    candidates.nz[0] = case_.n[2];
    candidates.offset[0] = static_cast<float>(kernel::plane_offset(slice, case_.n[0], case_.n[1], case_.n[2]) + 1);
    choose_planes(*map_, *columns_, rules_, candidates, slice, *choice_);
    sk_clearance_result result{};
    sk_clear_slice(map_.get(), &slice, choice_.get(), &rules_, &result);
    row.ours += result.verdict != SK_CLEAR ? 1 : 0;
    row.fcl += asked(*fcl_, body);
    row.bullet += asked(*bullet_, body);
    row.bullet_no_margin += asked(*bare_, body);
    const double length = std::sqrt(1.0 * case_.n[0] * case_.n[0] + 1.0 * case_.n[1] * case_.n[1] + 1.0 * case_.n[2] * case_.n[2]);
    const double micrometres = 1e3 * (steps + 1.0 * up_mm * case_.n[2]) / length;
    row.micrometres_least = row.cases == 0 ? micrometres : std::min(row.micrometres_least, micrometres);
    row.micrometres_most = row.cases == 0 ? micrometres : std::max(row.micrometres_most, micrometres);
    ++row.cases;
  }

 private:
  template <class Peer>
  static int asked(Peer& peer, const ConvexBody& body) {
    peer.clear_bodies();
    peer.add(body);
    return peer.hits(0) ? 1 : 0;
  }

  const Case case_;
  std::vector<std::int32_t> heights_;
  sk_clearance_rules rules_{};
  std::unique_ptr<sk_height_map> map_;
  std::unique_ptr<sk_columns> columns_;
  std::unique_ptr<sk_choice> choice_;
  std::unique_ptr<FclMap> fcl_;
  std::unique_ptr<BulletMap> bullet_, bare_;
};

}  // namespace

std::vector<GrazingRow> grazing_table(std::uint32_t seed) {
  struct Distance {
    const char* name;
    int steps, up_mm;
  };
  const Distance distances[] = {{"1 mm deep (along z)", 0, -1}, {"one lattice step deep", -1, 0}, {"touching", 0, 0}, {"one lattice step apart", 1, 0}, {"1 mm apart (along z)", 0, 1}, {"10 mm apart (along z)", 0, 10}};
  std::vector<GrazingRow> table;
  for (const Distance& d : distances) table.push_back({d.name, d.steps <= 0 && d.up_mm <= 0, 0, 0, 0, 0, 0, 0, 0});
  std::mt19937 random(seed);
  for (int i = 0; i < kCases; ++i) {
    Question question(draw(random));
    for (std::size_t k = 0; k < table.size(); ++k) question.ask(distances[k].steps, distances[k].up_mm, table[k]);
  }
  return table;
}

}  // namespace berm::bench

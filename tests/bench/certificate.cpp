#include "certificate.hpp"

#include <stdexcept>

#include "geometry/separation.hpp"
#include "pass_over.hpp"

namespace berm::bench {

namespace {

constexpr std::int64_t kNowUs = 100000000;

}  // namespace

Certificate::Certificate(const berm_parameters& parameters, const std::vector<std::int32_t>& heights_mm)
    : shape_(parameters), map_(new sk_height_map), columns_(new sk_columns), choice_(new sk_choice), slices_(new kernel::SliceSet) {
  sk_map_clear(map_.get());
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (!sk_map_insert(map_.get(), iy, ix, heights_mm[iy * SK_MAP_CELLS + ix], kNowUs - 1000000, parameters.generation_us))
        throw std::runtime_error("the map refuses a height");
  rules_.now_us = kNowUs;
  rules_.fresh_us = parameters.fresh_us;
  test::pass_over(rules_);
  prepare();
}

void Certificate::prepare() {
  if (!sk_columns_of(map_.get(), &rules_, columns_.get())) throw std::runtime_error("the core refuses the rules");
}

void Certificate::run(const sk_reach_box* boxes, int* blocked_slices_of_step) {
  for (int step = 0; step < kSteps; ++step) {
    if (!build_slices(shape_, boxes[step], *slices_)) throw std::runtime_error("no slices");
    int blocked = 0;
    for (int i = 0; i < slices_->count; ++i) {
      const sk_clearance_result result = clear_slice(*map_, *columns_, rules_, *slices_, i, *choice_);
      if (result.verdict != SK_CLEAR) ++blocked;
    }
    blocked_slices_of_step[step] = blocked;
  }
}

const kernel::SliceSet& Certificate::slices_of(const sk_reach_box& box) {
  if (!build_slices(shape_, box, *slices_)) throw std::runtime_error("no slices");
  return *slices_;
}

void Certificate::slices_only(const sk_reach_box* boxes) {
  for (int step = 0; step < kSteps; ++step)
    if (!build_slices(shape_, boxes[step], *slices_)) throw std::runtime_error("no slices");
}

}  // namespace berm::bench

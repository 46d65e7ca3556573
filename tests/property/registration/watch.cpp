#include "watch.hpp"

#include <cstdlib>

namespace berm::registration_test {

namespace {

std::uint64_t number(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

Seeds seeds(std::uint64_t otherwise) { return {number("BERM_SEED", 1), number("BERM_SEEDS", otherwise)}; }

std::string again(std::uint64_t seed) { return "seed " + std::to_string(seed) + "; again: BERM_SEED=" + std::to_string(seed) + " BERM_SEEDS=1"; }

double draw(Site& site, double low, double high) { return std::uniform_real_distribution<double>(low, high)(site.random); }

berm_parameters site_parameters() {
  berm_parameters p{};
  p.own_body_radius_mm = 3000;
  p.dig_zones = 1;
  p.dig_zone[0] = {3900, -4200, 10500, 4200, -3400, 1100};
  return p;
}

Watch::Watch(const SiteConfig& config, std::uint64_t seed) : site(config, seed), registration(std::make_unique<kernel::TerrainRegistration>(site_parameters())) {}

void Watch::run(double until_s, const std::function<void(double)>& change, bool stops) {
  while (now_s() < until_s) {
    if (change) change(now_s());
    site.scan(now_s(), returns_);
    for (const sk_point& p : returns_) registration->take(p);
    registration->step(cycle_ * 10000);
    ++cycle_;
    if (!registration->slipped() || found_s >= 0) continue;
    found_s = now_s();
    if (stops) return;
  }
}

}  // namespace berm::registration_test

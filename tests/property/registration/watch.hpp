// The registration, fed by a site in virtual time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geometry/terrain_registration.hpp"
#include "site.hpp"

namespace berm::registration_test {

// How many seeds a test takes: BERM_SEEDS, else the given number. The first is BERM_SEED, else 1.
struct Seeds {
  std::uint64_t first, count;
};
Seeds seeds(std::uint64_t otherwise);

class Watch {
 public:
  Watch(const SiteConfig& config, std::uint64_t seed);

  // Until the time, or until a slip is found where `stops`; before each cycle the site may be changed.
  void run(double until_s, const std::function<void(double)>& change = {}, bool stops = false);
  double now_s() const { return 0.01 * static_cast<double>(cycle_); }

  Site site;
  std::unique_ptr<kernel::TerrainRegistration> registration;
  double found_s = -1.0;  // first

 private:
  std::int64_t cycle_ = 0;
  std::vector<sk_point> returns_;
};

// How a failed seed is run again.
std::string again(std::uint64_t seed);

double draw(Site& site, double low, double high);

// Own body of 3 m; a dig zone in front, as on the bench.
berm_parameters site_parameters();

}  // namespace berm::registration_test

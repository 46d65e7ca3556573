// Who takes part in the plane benchmark. A party is bound to one sweep, whose points it has in its own library's form already: converting them is not
// timed. sweep must outlive its parties.
#pragma once

#include "planes_sweep.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::bench {

// The recogniser's plane stage (upright regions alone), and the whole recogniser (the walls of the bed that it found). In this order.
std::vector<PlaneParty> our_parties(const SweepPoints& sweep, const app::TruckRangeSet& ranges);

// Each method once with the settings that serve it best; or every setting that was tried, its values in its name.
std::vector<PlaneParty> pcl_parties(const SweepPoints& sweep, bool every_setting);
std::vector<PlaneParty> cgal_parties(const SweepPoints& sweep, bool every_setting);

// A party for the first of the settings, by its name; or one for each, by what a setting is called.
template <typename Settings, std::size_t count, typename Called, typename Run>
void add_parties(std::vector<PlaneParty>& parties, const char* name, const Settings (&all)[count], bool every_setting, const Called& called, const Run& run) {
  for (const Settings& s : all) {
    parties.push_back({every_setting ? std::string(name) + " " + called(s) : name, [run, s] { return run(s); }});
    if (!every_setting) break;
  }
}

// The neighbourhood of a denser sweep: only the angle between scanlines shrinks, so k neighbours reach as far up as along when they grow by the root.
int neighbours(const SweepPoints& sweep, int usual);
// Least returns of a plane.
int least_returns(const SweepPoints& sweep);

}  // namespace berm::bench

// A swing that would begin waits until the scanner that leads it has come to its trigger angle (leger-1998, 2.4), and no longer than that may take: a scanner that
// does not get there is made good for by the guard, which slows the swing over what was not seen.
#pragma once

#include <algorithm>
#include <optional>

#include "app/progress_log.hpp"
#include "perception/scan_scheduler.hpp"

namespace berm::app {

class ScanWait {
public:
  static constexpr double at_most_s = 1.5;  // from under the boom a pan comes out to the largest trigger angle of the shipped machines in two seconds and a half, and mostly it is on its way

  // Once a look at the script: whether the swing may begin. awaited: it would begin but for the scanner.
  bool step(double time_s, const Lead& lead, bool awaited, const char* way, const ProgressLog& log);
  // It has begun.
  void swing_began(double time_s, const Lead& lead, const char* way, const ProgressLog& log);

  // Once a cycle while it goes on.
  void goes_on(const Lead& lead) { least_spare_ = std::min(least_spare_, lead.ahead - lead.required); }
  // The least by which a scanner was ahead of what its swing's speed needed, rad; none: no swing has gone on.
  std::optional<double> least_spare() const { return least_spare_ < none ? std::optional(least_spare_) : std::nullopt; }

private:
  static constexpr double none = 1e9;
  double least_spare_ = none;
  double since_s_ = -1.0;   // it waits
  bool late_ = false;       // and waited in vain
};

}  // namespace berm::app

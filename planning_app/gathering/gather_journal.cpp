#include "gathering/gather_journal.hpp"

#include <fmt/format.h>

#include <new>

#include "points/point_cloud.hpp"

namespace berm::app {

std::size_t gather_journal(JournalScans& journal, const ScannerDeviations& deviations, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer,
                           const std::function<void()>& progress) {
  std::array<std::size_t, BERM_SCANNERS> number{};
  std::array<KinematicChain, BERM_SCANNERS> chain;
  for (std::size_t scanner = 0; scanner < number.size(); ++scanner) {
    chain[scanner] = journal.chain(scanner);
    number[scanner] = gatherer.add_scanner(deviations, chain[scanner]);
  }
  std::size_t cleared = 0;
  double cleared_s = -1.0;
  EncodedScan scan;
  try {
    while (journal.next(scan)) {
      if (scan.begun_anew_s > cleared_s) {  // both scanners tell it
        gatherer.clear();
        cleared_s = scan.begun_anew_s;
        ++cleared;
      }
      gatherer.add_scan(number[scan.scanner], mount * chain[scan.scanner].pose(scan.encoder), scan.returns, scan.time_s);
      if (progress) progress();
    }
  } catch (const std::bad_alloc&) {
    throw PointFileError(fmt::format("{}: memory: too little to gather cycle {} beside {} points that are kept (--capacity {})", journal.path(), journal.cycles(),
                                     gatherer.store().size(), gatherer.store().capacity()));
  }
  return cleared;
}

}  // namespace berm::app

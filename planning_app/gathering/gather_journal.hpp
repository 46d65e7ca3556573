// Plays a journal into the gathering, scanline by scanline, each in the plane that the encoders tell.
#pragma once

#include <functional>

#include "gathering/gatherer.hpp"
#include "gathering/journal_scans.hpp"

namespace berm::app {

// Adds both scanners of the journal to the gatherer and plays it to its end. mount: from the cloud's frame to the base frame. Where the kernel began its
// map anew (a bench move, a slip of the base, the panel's relearn) the cloud is cleared as well (zolynski-2012, 2.3). progress() is called after each
// scanline. Returns how often the cloud was cleared. Throws PointFileError when the journal is damaged or memory too small.
std::size_t gather_journal(JournalScans& journal, const ScannerDeviations& deviations, const Eigen::Isometry3d& mount, PointCloudGatherer& gatherer,
                           const std::function<void()>& progress = {});

}  // namespace berm::app

// Scanline processing (stentz-1999, Figure 5 and section 3): from what a panning scanner measured to Cartesian points in the base frame, with the
// machine's pose at the time of each sample, and to a judgement of each return. Metres, radians, seconds of the kernel's clock.
//
// Of several echoes the last counts (last pulse; it is the only one whose range the kernel publishes), and an echo before it is a sign of dust, or of
// an edge. A return that nothing beside it in its scanline supports hangs in the air, or lies behind what surrounds it: noise, dust that alone came
// back, or something very thin. The base frame is the machine's: a base that tilts takes it along, as it does the kernel's map.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "contract/berm_contract.h"
#include "gathering/kinematic_chain.hpp"
#include "motion/machine_model.hpp"
#include "motion/own_machine.hpp"
#include "perception/machine_history.hpp"
#include "perception/projection_check.hpp"

namespace berm::app {

struct ScanReturn {
  double range = 0.0;  // 0: nothing came back, or from nearer or farther than the machine file's range, or the machine's pose is not known
  double x = 0.0, y = 0.0, z = 0.0;
  double time_s = 0.0;
  bool own = false;             // from the machine itself
  bool several_echoes = false;  // one before the last: dust, or an edge
  bool lone = false;            // no neighbour in its scanline agrees with it

  bool usable() const { return range > 0.0 && !own; }
  bool flagged() const { return several_echoes || lone; }
};

// Consecutive samples of one scanline.
struct ScanlinePart {
  std::size_t scanner = 0;
  std::uint32_t scanline = 0;
  int first_index = 0, samples_per_revolution = 0;
  double swing = 0.0;           // the machine's in the middle of it; 0: its pose is not known, and nothing came back
  int count = 0;
  std::array<ScanReturn, BERM_SCAN_BLOCK_SAMPLES> sample{};

  std::span<const ScanReturn> samples() const { return {sample.data(), static_cast<std::size_t>(count)}; }
};

// From the base frame to the scan plane of a scanner, joint values swing and pan: x along the beam forward and level, y along the beam upward.
KinematicChain scanner_chain(const ScannerMount& mount);

// Whether the block's fields are within the bounds of SCAN.md.
bool well_formed(const berm_scan_block& block);

class ScanlineProcessor {
public:
  explicit ScanlineProcessor(const MachineModel& machine);

  // Well-formed blocks of each scanner in measuring order. What is finished now: the block before it, which has waited for its neighbours, and this
  // one where it ends its turn of the mirror. Valid until the next call.
  std::span<const ScanlinePart> take(const berm_scan_block& block, const MachineHistory& history);

  const ProjectionCheck& check() const { return check_; }

private:
  static constexpr int neighbours = 2;  // samples on each side that may support a return

  struct Line {
    bool waiting = false;
    ScanlinePart part;                             // the one that waits, or the newest
    std::array<ScanReturn, neighbours> before{};   // the samples before it, nearest first
  };
  void locate(const berm_scan_block& block, const MachineHistory& history, ScanlinePart& part);
  void judge(Line& line, const ScanlinePart* after) const;

  MachineModel machine_;
  std::array<KinematicChain, BERM_SCANNERS> chain_;
  OwnMachine own_;
  ProjectionCheck check_;
  std::array<Line, BERM_SCANNERS> line_;
  std::array<ScanlinePart, 2> finished_;
};

}  // namespace berm::app

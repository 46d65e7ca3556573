// Whole scanlines of a recorded run with the angles of swing and pan, out of a journal of the kernel (interface_spec/journal/JOURNAL.md). What came back
// from the machine itself is left out, by the angles of its joints: it stands too near to be gathered, a scanner meets it with thousands of rays.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "gathering/deletion_volume.hpp"
#include "gathering/kinematic_chain.hpp"
#include "journal/mcap_reader.hpp"
#include "motion/own_machine.hpp"
#include "scan/scan_packet.h"

namespace berm::app {

struct EncodedScan {
  std::size_t scanner = 0;               // 0 left, 1 right
  double time_s = 0.0;                   // kernel's clock; of the middle one of its returns
  std::array<double, 2> encoder{};       // swing and pan at that time, radians: the joint values of its chain
  double begun_anew_s = -1.0;            // when the kernel began its map anew last, for the machine may stand elsewhere since; negative: not since the start
  std::vector<PolarReturn> returns;      // in the scan plane of that time, in rising angle
};

class JournalScans {
public:
  // Opens the journal and reads as far as its parameter block. Throws PointFileError.
  explicit JournalScans(const std::string& path);

  // Whether the file begins as a journal does; false as well where it cannot be read, or is no regular file.
  static bool is_journal(const std::string& path);

  // From the base frame to each scanner's plane, by the encoders of swing (0) and pan (1).
  KinematicChain chain(std::size_t scanner) const;

  // The next scanline that anything came back of, in the order in which they ended; false at the journal's end. A journal that was cut off ends
  // where it was; of a scanline of which a part was lost the rest is given. Throws PointFileError when it is damaged.
  bool next(EncodedScan& scan);

  bool cut_off() const { return cut_off_; }         // at the end: it was, and what came before is all
  std::uint64_t cycles() const { return cycles_; }  // read so far
  const std::string& path() const { return path_; }

private:
  struct Sample { double time_s, mirror_rad, pan_rad, range_m; };
  struct Line { std::uint32_t scanline = 0; int next_index = 0; std::size_t scanner = 0; double begun_anew_s = -1.0; std::vector<Sample> samples; };
  struct Arm { double time_s; Joints angle; };  // radians; of the swing going on beyond a turn
  bool read_cycle();
  void take_cycle(const std::uint8_t* bytes, std::size_t size);
  void take_packet(const berm_scan_packet& packet);
  void take_state(const berm_state& state);
  void finish(std::size_t scanner);
  Joints angles_at(double time_s) const;
  void project(const Line& line, EncodedScan& scan);
  [[noreturn]] void damaged(const std::string& what) const;

  std::string path_;
  record::McapReader reader_;
  record::McapItem item_;
  berm_parameters parameters_{};
  std::array<Line, BERM_SCANNERS> open_;
  std::deque<Line> whole_;  // wait for the joints' angles at their times
  std::deque<Arm> arm_;     // of the last seconds, in rising time
  std::optional<OwnMachine> own_;
  std::uint32_t confirmed_ms_ = UINT32_MAX;
  double begun_anew_s_ = -1.0;
  std::uint64_t cycles_ = 0;
  bool ended_ = false, cut_off_ = false;
};

}  // namespace berm::app

// The kernel's whole cycle under its full load, without its sockets: two panning scanners, a VLP-16 at 10 Hz, an app that swings and digs at the air,
// a wall that is now and then in the way; published and offered to the journal as the shell does.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cycle_rig.hpp"
#include "io/journal.hpp"
#include "io/publisher.hpp"

namespace berm::kernel::test {

class LoadedKernel {
 public:
  LoadedKernel();

  // False with one line in error.
  bool open(std::string& error);

  void gather();        // the world's and the app's part
  void kernel_cycle();  // the kernel's part: what is measured
  void obey() { rig_.obey(); }

  const berm_state& state() const { return rig_.out->state; }
  const berm_decision& decision() const { return rig_.out->decision; }
  const berm_parameters& parameters() const { return rig_.parameters; }
  std::uint64_t journal_offered() const { return journal_.offered(); }
  std::uint64_t journal_lost() const { return journal_.lost(); }
  std::uint64_t rejected() const { return rig_.cycle->frames_rejected() + rig_.cycle->scans_rejected() + vlp16_refused_; }

 private:
  using Bytes = std::array<std::uint8_t, kVlp16PacketBytes>;
  static std::vector<Bytes> one_second_of_vlp16();

  CycleRig rig_;
  const std::vector<Bytes> lidar_;
  std::size_t next_lidar_ = 0;
  std::vector<const Bytes*> arrived_;
  std::unique_ptr<Vlp16Packet> scratch_;
  std::unique_ptr<berm_state_segment> segment_;
  std::unique_ptr<Publisher> publisher_;
  Journal journal_;
  std::uint64_t vlp16_refused_ = 0;
};

}  // namespace berm::kernel::test

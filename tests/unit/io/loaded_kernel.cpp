#include "loaded_kernel.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cmath>

namespace berm::kernel::test {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Vlp16Mount kMount{0.0, 0.0, 3.3, 0.0};
constexpr double kRingM = 13.0;          // a wall all round, so that every channel has a return
constexpr int kPacketsASecond = 754;     // 12 blocks of 110.592 us each
constexpr double kBlockCdeg = 39.813;    // turned meanwhile at 10 Hz
constexpr int kRankOfLaser[16] = {0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15};
constexpr std::uint32_t kLegCycles = 400, kWallCycles = 3000;

// The workspace watched as well: all that a cycle can be asked to do.
berm_parameters watched() {
  berm_parameters p = berm::test::demo_parameters();
  p.workspace_watched = 1;
  return p;
}

}  // namespace

LoadedKernel::LoadedKernel()
    : rig_(watched()), lidar_(one_second_of_vlp16()), scratch_(std::make_unique<Vlp16Packet>()), segment_(std::make_unique<berm_state_segment>()) {
  publisher_ = std::make_unique<Publisher>(*segment_, rig_.parameters, true);
  arrived_.reserve(16);
}

bool LoadedKernel::open(std::string& error) { return journal_.create(rig_.parameters, false, kMount, error); }

std::vector<LoadedKernel::Bytes> LoadedKernel::one_second_of_vlp16() {
  std::vector<Bytes> out(kPacketsASecond);
  int block = 0;
  for (Bytes& bytes : out) {
    for (std::size_t b = 0; b < 12; ++b, ++block) {
      std::uint8_t* to = bytes.data() + 100 * b;
      const int azimuth = static_cast<int>(block * kBlockCdeg) % 36000;
      to[0] = 0xFF;
      to[1] = 0xEE;
      to[2] = static_cast<std::uint8_t>(azimuth & 0xFF);
      to[3] = static_cast<std::uint8_t>(azimuth >> 8);
      for (std::size_t k = 0; k < 32; ++k) {
        const double elevation = (-15 + 2 * kRankOfLaser[k % 16]) * kPi / 180.0;
        double range = kRingM / std::cos(elevation);
        if (elevation < 0) range = std::min(range, kMount.z_m / -std::sin(elevation));
        const auto units = static_cast<std::uint32_t>(std::lround(range * 500.0));
        to[4 + 3 * k] = static_cast<std::uint8_t>(units & 0xFF);
        to[5 + 3 * k] = static_cast<std::uint8_t>(units >> 8);
        to[6 + 3 * k] = 40;
      }
    }
    bytes[1204] = 0x37;
    bytes[1205] = 0x22;
  }
  return out;
}

void LoadedKernel::gather() {
  const std::uint32_t cycle = rig_.machine.cycle();
  // Legs of 4 s: left, right; the arm reaches out and in meanwhile. The wall stands for every other half minute.
  const std::uint32_t leg = cycle / kLegCycles;
  const std::int32_t way = leg % 2 == 0 ? 1 : -1, arm = leg / 2 % 2 == 0 ? 1 : -1;
  const std::int32_t wanted[4] = {way * 500000, arm * 60000, -arm * 80000, arm * 100000};
  std::copy(wanted, wanted + 4, rig_.wanted_urad_s);
  rig_.machine.wall = cycle / kWallCycles % 2 == 1 ? berm::test::Wall{7.5, 2.5} : berm::test::Wall{};
  rig_.gather();
  arrived_.clear();
  const std::size_t until = (static_cast<std::size_t>(cycle % 100) + 1) * kPacketsASecond / 100 - static_cast<std::size_t>(cycle % 100) * kPacketsASecond / 100;
  for (std::size_t i = 0; i < until; ++i, next_lidar_ = (next_lidar_ + 1) % lidar_.size()) arrived_.push_back(&lidar_[next_lidar_]);
}

void LoadedKernel::kernel_cycle() {
  CycleInputs& in = *rig_.in;
  for (const Bytes* bytes : arrived_) vlp16_refused_ += in.take_vlp16(kMount, bytes->data(), bytes->size(), *scratch_) ? 0 : 1;
  rig_.cycle->step(in, *rig_.out);
  publisher_->state(rig_.out->state);
  publisher_->decision(rig_.out->decision);
  publisher_->scans(rig_.out->blocks);
  publisher_->slices(rig_.cycle->slices());
  publisher_->map_rows(rig_.cycle->map(), in.now_us);
  publisher_->wake();
  journal_.offer(in, *rig_.out, rig_.cycle->map(), true);
}

}  // namespace berm::kernel::test

// Counts every allocation of the process during cycles: malloc itself is replaced.
#include <gtest/gtest.h>
#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "can/can_transport.hpp"
#include "counted_malloc.hpp"
#include "cycle_rig.hpp"
#include "io/publisher.hpp"

namespace berm::kernel::test {
namespace {

// The cycle alone: inputs are recorded from a first run, then given to a second kernel.
// verifies: SK-CY-42
TEST(NoAllocation, InACycle) {
  if (!BERM_COUNTS_MALLOC) GTEST_SKIP() << "SKIPPED: malloc is the sanitizer's";
  const long probe = allocations;
  delete new std::vector<int>(100);
  ASSERT_GT(allocations, probe) << "the counter does not count";

  constexpr int kCycles = 500;
  CycleRig first;
  std::vector<std::vector<berm_can_frame>> frames;
  std::vector<std::vector<berm_scan_packet>> packets;
  std::vector<std::vector<std::uint8_t>> requests;
  std::vector<int> states;
  for (int i = 0; i < kCycles; ++i) {
    first.wanted_urad_s[0] = i > 250 ? -300000 : 0;
    first.step();
    frames.emplace_back(first.in->frame, first.in->frame + first.in->frame_count);
    packets.emplace_back(first.in->packet, first.in->packet + first.in->packet_count);
    requests.emplace_back(first.in->request, first.in->request + SK_REQUEST_BYTES);
    states.push_back(first.state().kernel_state);
  }

  const auto cycle = std::make_unique<Cycle>(first.parameters, false);  // larger than a stack
  auto segment = std::make_unique<berm_state_segment>();
  Publisher publisher(*segment, first.parameters, true);
  auto& in = *first.in;
  auto& out = *first.out;
  const long before = allocations;
  int running = 0, different = 0;
  for (int i = 0; i < kCycles; ++i) {
    const auto k = static_cast<std::size_t>(i);
    in.clear();
    in.cycle = static_cast<std::uint64_t>(i + 1);
    in.now_us = (i + 1) * berm::test::kCycleUs;
    for (const auto& frame : frames[k]) in.frame[in.frame_count++] = frame;
    for (const auto& packet : packets[k]) in.packet[in.packet_count++] = packet;
    std::copy(requests[k].begin(), requests[k].end(), in.request);
    cycle->step(in, out);
    publisher.state(out.state);
    publisher.decision(out.decision);
    publisher.scans(out.blocks);
    publisher.slices(cycle->slices());
    publisher.map_rows(cycle->map(), in.now_us);
    publisher.wake();
    running += out.state.kernel_state == BERM_STATE_RUN ? 1 : 0;
    different += out.state.kernel_state != states[k] ? 1 : 0;
  }
  const long counted = allocations - before;
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(different, 0);
  EXPECT_GT(running, 100);
  EXPECT_EQ(segment->decision_head, static_cast<std::uint32_t>(kCycles));
  std::cout << kCycles << " cycles, " << running << " in RUN, " << counted << " allocations\n";
}

// verifies: IF-CAN-19 (that neither allocates, and that a wait ends)
TEST(NoAllocation, InATransport) {
  if (!BERM_COUNTS_MALLOC) GTEST_SKIP() << "SKIPPED: malloc is the sanitizer's";
  can::Transport a;
  const std::string error = a.open("udp:239.255.66.78:" + std::to_string(20000 + getpid() % 20000));
  ASSERT_EQ(error, "");
  berm_can_frame many[75], got{};
  for (int i = 0; i < 75; ++i) many[i] = {BERM_CAN_HEARTBEAT, 8, {static_cast<std::uint8_t>(i)}};
  int received = 0;
  const long before = allocations;
  for (int round = 0; round < 20; ++round) {
    const bool sent = a.send(many[0]) && a.send(many, 75);
    for (int i = 0; sent && i < 76; ++i) received += a.receive(got, 1000) ? 1 : 0;
    received += a.receive(got) ? 1 : 0;
  }
  received += a.receive(got, 20) ? 1 : 0;  // nothing is there: it comes back
  const long counted = allocations - before;
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(received, 20 * 76);
}

}  // namespace
}  // namespace berm::kernel::test

// A cycle in which a stop is pressed and let go, through its record: the replay stops as well, and decides the same to the bit.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>
#include <memory>
#include <vector>

#include "cycle_rig.hpp"
#include "io/journal.hpp"
#include "record/cycle_record.hpp"
#include "record/ring_reader.hpp"

namespace berm::record {
namespace {

using kernel::test::CycleRig;

void press_and_let_go(CycleRig& rig) {
  for (const bool pressed : {true, false}) {
    const berm_operator panel{true, pressed, false, false, 0};
    rig.machine.add_guarded(berm_encode_operator(&panel));
    const auto& sent = rig.machine.frames();
    for (std::size_t k = 2; k > 0; --k) rig.in->frame[rig.in->frame_count++] = sent[sent.size() - k];
  }
}

// verifies: SK-CY-40, SK-CY-83, SK-JO-1
TEST(BatchReplay, AStopThatLastsWithinACycleIsReplayed) {
  CycleRig rig;
  kernel::Journal journal;
  std::string error;
  ASSERT_TRUE(journal.create(rig.parameters, false, kernel::Vlp16Mount{}, error)) << error;
  void* mapped = mmap(nullptr, journal.tail().size(), PROT_READ | PROT_WRITE, MAP_SHARED, journal.tail().fd(), 0);
  ASSERT_NE(mapped, MAP_FAILED);
  RingReader reader(*static_cast<const berm_journal_ring*>(journal.ring().view()), *static_cast<berm_journal_tail*>(mapped));
  const auto replayed = std::make_unique<kernel::Cycle>(rig.parameters, false);
  const auto in = std::make_unique<kernel::CycleInputs>();
  const auto out = std::make_unique<kernel::CycleOutputs>();
  std::vector<std::uint8_t> record;
  RecordedOutputs recorded;
  int pressed_at = -1;
  for (int k = 0; k < 2000 && (pressed_at < 0 || k < pressed_at + 100); ++k) {
    rig.gather();
    if (pressed_at < 0 && rig.state().kernel_state == BERM_STATE_RUN) {
      press_and_let_go(rig);
      pressed_at = k;
    }
    rig.cycle->step(*rig.in, *rig.out);
    journal.offer(*rig.in, *rig.out, rig.cycle->map(), true);
    rig.obey();
    ASSERT_EQ(reader.next(record), RingReader::Result::kRecord);
    ASSERT_TRUE(decode_cycle(record.data(), record.size(), {}, *in, recorded, error)) << error;
    replayed->step(*in, *out);
    ASSERT_EQ(std::memcmp(&out->decision, &rig.out->decision, sizeof(berm_decision)), 0) << k;
    ASSERT_EQ(std::memcmp(&out->state, &rig.out->state, sizeof(berm_state)), 0) << k;
  }
  ASSERT_GE(pressed_at, 0);
  EXPECT_EQ(out->state.stop_reason, BERM_STOP_OPERATOR);
  munmap(mapped, sizeof(berm_journal_tail));
}

}  // namespace
}  // namespace berm::record

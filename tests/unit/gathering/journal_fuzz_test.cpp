// Journals of bytes that no kernel wrote.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "gathering/journal_scans.hpp"
#include "made_journal.hpp"
#include "points/point_cloud.hpp"
#include "scratch.hpp"

namespace berm::app {
namespace {

using namespace made_journal;

// Bytes of the records that no kernel wrote, under checksums that are right; and files cut and changed anywhere.
TEST(JournalScans, NoBytesCrashIt) {
  const berm::test::Scratch scratch;
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  const auto any = [&](std::size_t below) { return static_cast<std::size_t>(random() % below); };
  int refused = 0, read = 0;
  const auto play = [&](const std::string& path) {
    try {
      JournalScans journal(path);
      EncodedScan scan;
      while (journal.next(scan))
        for (const PolarReturn& r : scan.returns) EXPECT_TRUE(std::isfinite(r.angle_rad) && std::isfinite(r.range_m));
      ++read;
    } catch (const PointFileError&) {
      ++refused;
    }
  };
  const std::vector<Bytes> good = records(12);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Bytes> all = good;
    for (int k = 0; k < 6; ++k) {
      Bytes& bytes = all[any(all.size())];
      bytes[any(2) == 0 ? any(bytes.size()) : (sizeof(berm_journal_cycle) + any(sizeof(berm_journal_scan))) % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    if (trial % 5 == 0) all[any(all.size())].resize(any(sizeof(berm_journal_cycle) + 64) / 8 * 8 + 8);
    // The writer files only what has a record's length in it.
    for (Bytes& bytes : all) {
      const auto size = static_cast<std::uint32_t>(bytes.size());
      if (bytes.size() >= sizeof(berm_journal_cycle)) std::memcpy(bytes.data() + offsetof(berm_journal_cycle, bytes), &size, sizeof size);
    }
    std::erase_if(all, [](const Bytes& bytes) { return bytes.size() < sizeof(berm_journal_cycle); });
    play(written(scratch, "forged.mcap", all));
  }
  std::ifstream in(written(scratch, "good.mcap", good), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  for (int trial = 0; trial < 200; ++trial) {
    std::string bytes = whole.substr(0, trial % 2 == 0 ? whole.size() : any(whole.size()));
    if (trial % 2 == 0) bytes[any(bytes.size())] = static_cast<char>(random());
    play(scratch.write("changed.mcap", bytes));
  }
  std::printf("seed %u: %d refused, %d read\n", seed, refused, read);
  EXPECT_GT(refused, 150);
  EXPECT_GT(read, 50);
}

}  // namespace
}  // namespace berm::app

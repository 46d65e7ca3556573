// Any bytes may come: a reader accepts a file whole, or refuses it with one line. BERM_SAMPLES sets the number of mutants of each file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

#include "points/lms111.hpp"
#include "points/pcap.hpp"
#include "points/pcd.hpp"
#include "points/recording.hpp"
#include "sample_files.hpp"

namespace berm::app {
namespace {

using namespace test;

struct Tally {
  int accepted = 0, refused = 0;
};

template <typename Parse>
void take(Parse parse, const std::string& bytes, Tally& tally) {
  const std::vector<char> block(bytes.begin(), bytes.end());  // a read beyond it is one beyond its memory
  try {
    const PointCloud cloud = parse(std::string_view(block.data(), block.size()), "mutant");
    ++tally.accepted;
    std::uint32_t scanline = 0;
    for (const ScanPoint& p : cloud.points) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.time_s));
      ASSERT_GE(p.scanline, scanline);
      scanline = p.scanline;
    }
    ASSERT_LE(cloud.points.size(), bytes.size());  // no point without a byte
  } catch (const PointFileError& error) {
    ++tally.refused;
    const std::string line = error.what();
    ASSERT_TRUE(std::none_of(line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c > '~'; })) << line;
    ASSERT_LE(line.size(), 300U) << line;
    ASSERT_EQ(line.rfind("mutant: ", 0), 0U) << line;
  }
}

template <typename Parse>
void fuzz(Parse parse, const std::string& whole) {
  const char* samples = std::getenv("BERM_SAMPLES");
  const int count = samples != nullptr ? std::atoi(samples) : 3000;
  constexpr unsigned kSeed = 20;
  std::mt19937 draw(kSeed);
  Tally tally;
  take(parse, whole, tally);
  ASSERT_EQ(tally.accepted, 1);
  static const std::string kPieces[] = {"-1", "99999999", "nan", "inf", "1e999", "\n", " ", std::string(8, '\xFF'), std::string(4, '\0'), ":", "\x02\x02\x02\x02"};
  for (int i = 0; i < count; ++i) {
    std::string bytes = whole;
    for (unsigned edits = draw() % 4 + 1; edits > 0 && !bytes.empty(); --edits) {
      const std::size_t at = draw() % (draw() % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 200));
      switch (draw() % 6) {
        case 0: bytes[at] = static_cast<char>(draw()); break;
        case 1: bytes[at] = static_cast<char>(bytes[at] ^ 1 << draw() % 8); break;
        case 2: bytes.resize(at); break;
        case 3: bytes.erase(at, draw() % 9); break;
        case 4: bytes.insert(at, bytes.substr(draw() % bytes.size(), draw() % 40)); break;
        default: {
          const std::string& piece = kPieces[draw() % std::size(kPieces)];
          bytes.replace(at, std::min(piece.size(), bytes.size() - at), piece);
        }
      }
    }
    take(parse, bytes, tally);
    if (testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "mutant " << i << " of seed " << kSeed;
      return;
    }
  }
  EXPECT_GT(tally.refused, count / 10);
  printf("%d accepted, %d refused\n", tally.accepted, tally.refused);
}

TEST(PointReadersFuzz, PcdAscii) { fuzz(parse_pcd, pcd_header("3", "ascii") + "1 2 3 0 0.5\n4 5 6 1 0.6\n7 8 9 1 0.7\n"); }
TEST(PointReadersFuzz, PcdBinary) { fuzz(parse_pcd, pcd_header("3", "binary") + std::string(72, '\0')); }
TEST(PointReadersFuzz, PcdCompressed) {
  std::string data;
  put32(data, 5);
  put32(data, 72);
  fuzz(parse_pcd, pcd_header("3", "binary_compressed") + data + std::string("\x00\x00\xE0\x3E\x00", 5));
}
TEST(PointReadersFuzz, Pcap) {
  const auto steps = [](unsigned block) { return 400 + 100 * block; };
  fuzz(parse_pcap, pcap_of({vlp16_packet(1, 0, false, steps), vlp16_packet(2, 480, true, steps), "other"}));
}
TEST(PointReadersFuzz, LaserSession) {
  const std::string scan = cola_b(lmd_scandata(1, {{"DIST1", 0x3F800000, 0, 5000, {1000, 2000, 3000}}}, {{"RSSI1", 0x3F800000, 0, 5000, {1, 2, 3}}}));
  fuzz(parse_lms, tshark_json({scan.substr(0, 40), scan.substr(40), cola_b("sAN other")}));
}
// The telegram itself, its checksum made right again.
TEST(PointReadersFuzz, LaserTelegram) {
  const std::string body = lmd_scandata(1, {{"DIST1", 0x3F800000, 0, 5000, {1000, 2000, 3000}}}, {{"RSSI1", 0x3F800000, 0, 5000, {1, 2, 3}}});
  fuzz([](std::string_view bytes, const std::string& name) { return parse_lms(tshark_json({cola_b(std::string(bytes))}), name); }, body);
}
TEST(PointReadersFuzz, AnyFormat) { fuzz(parse_recording, pcd_header("1", "ascii") + "1 2 3 0 0\n"); }

}  // namespace
}  // namespace berm::app

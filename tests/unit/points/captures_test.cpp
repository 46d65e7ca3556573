#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "points/lms111.hpp"
#include "points/pcap.hpp"
#include "points/recording.hpp"
#include "sample_files.hpp"

namespace berm::app {
namespace {

using namespace test;

template <typename Parse>
std::string refusal(Parse parse) {
  try {
    parse();
  } catch (const PointFileError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "accepted";
}

std::string capture_refusal(const std::string& bytes) {
  return refusal([&] { parse_pcap(bytes, "c.pcap"); });
}
std::string session_refusal(const std::string& bytes) {
  return refusal([&] { parse_lms(bytes, "s.json"); });
}

TEST(Pcap, SingleReturnPacketIsTwentyFourColumns) {
  const auto cloud = parse_pcap(pcap_of({vlp16_packet(1000, 9000, false, [](unsigned) { return 1000U; }), "other traffic"}), "c.pcap");
  ASSERT_EQ(cloud.points.size(), 24U * 16U);
  EXPECT_EQ(cloud.points.front().scanline, 0U);
  EXPECT_EQ(cloud.points.back().scanline, 23U);
  EXPECT_NEAR(cloud.points.front().time_s, 1e-3, 1e-9);
  EXPECT_NEAR(cloud.points.back().time_s, 1e-3 + 23 * 55.296e-6, 1e-9);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const ScanPoint& p = cloud.points[i];
    EXPECT_NEAR(std::hypot(p.x, p.y, p.z), 2.0, 1e-5);
    const double elevation = std::asin(static_cast<double>(p.z) / 2.0) * 57.29577951308232;
    EXPECT_NEAR(elevation, -15.0 + 2.0 * static_cast<double>(i % 16), 1e-3);
    // Azimuth grows clockwise; half a block's turn from firing to firing, and each laser's share of it.
    const double azimuth = -std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) * 57.29577951308232;
    EXPECT_NEAR(azimuth, 90.0 + 0.2 * p.scanline + 0.2 * 0.5 * 34.56 / 55.296, 0.2 * 0.5 * 34.56 / 55.296 + 1e-3);
  }
}

TEST(Pcap, DualReturnTakesTheFarther) {
  const auto cloud = parse_pcap(pcap_of({vlp16_packet(0, 0, true, [](unsigned block) { return block % 2 == 0 ? 1500U : 600U; }),
                                         vlp16_packet(2000, 240, true, [](unsigned block) { return block % 2 == 0 ? 0U : 700U; }),
                                         vlp16_packet(4000, 480, true, [](unsigned) { return 199U; })}), "c.pcap");
  ASSERT_EQ(cloud.points.size(), 2U * 12U * 16U);  // nothing nearer than 0.4 m
  EXPECT_NEAR(std::hypot(cloud.points.front().x, cloud.points.front().y, cloud.points.front().z), 3.0, 1e-5);
  EXPECT_NEAR(std::hypot(cloud.points.back().x, cloud.points.back().y, cloud.points.back().z), 1.4, 1e-5);
  EXPECT_EQ(cloud.points.back().scanline, 23U);
}

TEST(Pcap, TheClockGoesOnOverTheHour) {
  const auto steps = [](unsigned) { return 1000U; };
  const auto cloud = parse_pcap(pcap_of({vlp16_packet(3599'999'000, 0, false, steps), vlp16_packet(500, 480, false, steps)}), "c.pcap");
  EXPECT_NEAR(cloud.points.back().time_s, 3600.0005 + 23 * 55.296e-6, 1e-6);
}

TEST(Pcap, Refusals) {
  const auto steps = [](unsigned) { return 1000U; };
  const std::string packet = vlp16_packet(1000, 0, false, steps), good = pcap_of({packet});
  EXPECT_EQ(capture_refusal(good), "accepted");
  EXPECT_EQ(capture_refusal("").rfind("c.pcap: size", 0), 0U);
  EXPECT_EQ(capture_refusal("no capture at all, but long enough for a header").rfind("c.pcap: header", 0), 0U);
  EXPECT_EQ(capture_refusal(good.substr(0, good.size() - 1)).rfind("c.pcap: packet 1", 0), 0U);
  EXPECT_EQ(capture_refusal(pcap_of({"x"})).rfind("c.pcap: packets", 0), 0U);
  EXPECT_NE(capture_refusal(pcap_of({packet, vlp16_packet(999, 0, false, steps)})).find("packet 2: clock: runs backwards"), std::string::npos);
  const auto with = [&](std::size_t at, char value) {
    std::string bad = packet;
    bad[at] = value;
    return capture_refusal(pcap_of({bad}));
  };
  EXPECT_NE(with(1204, '\x40').find("return mode"), std::string::npos);
  EXPECT_NE(with(1205, '\x21').find("product"), std::string::npos);
  EXPECT_NE(with(200, '\0').find("block flag"), std::string::npos);
  EXPECT_NE(with(103, '\x90').find("azimuth"), std::string::npos);
  EXPECT_NE(with(1203, '\xFF').find("clock"), std::string::npos);
  std::string snapped = good;  // the record claims more than was captured
  snapped[24 + 13] = '\x7F';
  EXPECT_NE(capture_refusal(snapped).find("packet 1"), std::string::npos);
  std::string huge = good;  // a record of 2 GB
  huge[24 + 11] = huge[24 + 15] = '\x7F';
  EXPECT_NE(capture_refusal(huge).find("packet 1"), std::string::npos);
}

TEST(Lms, ScanInEveryDetail) {
  const auto scan = parse_lmd_scandata(lmd_scandata(123456, {{"DIST1", 0x40000000, -450000, 5000, {500, 0, 700}}, {"RSSI1", 0x3F800000, -450000, 5000, {9, 8, 7}}},
                                                    {{"RSSI2", 0x3F800000, -450000, 5000, {255, 1, 2}}}), "s");
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->scan_counter, 7);
  EXPECT_EQ(scan->since_startup_us, 123456U);
  EXPECT_EQ(scan->scan_rate_hz, 50.0);
  ASSERT_TRUE(scan->clock_s);
  EXPECT_NEAR(*scan->clock_s, 3723.5, 1e-9);
  ASSERT_EQ(scan->channels.size(), 3U);
  EXPECT_EQ(scan->channels[0].content, "DIST1");
  EXPECT_NEAR(scan->channels[0].start_rad, -0.7853981633974483, 1e-12);
  EXPECT_NEAR(scan->channels[0].step_rad, 0.008726646259971648, 1e-12);
  EXPECT_EQ(scan->channels[0].value, (std::vector<float>{1000, 0, 1400}));  // scaled by 2
  EXPECT_EQ(scan->channels[1].value, (std::vector<float>{9, 8, 7}));
  EXPECT_EQ(scan->channels[2].value, (std::vector<float>{255, 1, 2}));
  EXPECT_FALSE(parse_lmd_scandata("sAN SetAccessMode \1", "s"));
}

std::string one_scan(std::uint32_t startup_us, std::vector<unsigned> first, std::vector<unsigned> second = {}) {
  std::vector<LmsChannelSample> wide{{"DIST1", 0x3F800000, 0, 5000, std::move(first)}};
  if (!second.empty()) wide.push_back({"DIST2", 0x3F800000, 0, 5000, std::move(second)});
  return cola_b(lmd_scandata(startup_us, wide, {}));
}

TEST(Lms, TelegramsSplitAndJoinedOverPayloads) {
  const std::string stream = one_scan(4294967000U, {1000, 2000}, {0, 3000}) + cola_b("sAN other \1") + one_scan(704, {1000, 0, 500});
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    const auto cloud = parse_lms(tshark_json({"rest of a telegram" + stream.substr(0, cut), stream.substr(cut)}), "s.json");
    ASSERT_EQ(cloud.points.size(), 4U) << cut;
    EXPECT_NEAR(std::hypot(cloud.points[1].x, cloud.points[1].y), 3.0, 1e-6);  // the farther return
    EXPECT_NEAR(std::atan2(cloud.points[3].y, cloud.points[3].x), 2 * 0.008726646259971648, 1e-6);
    EXPECT_EQ(cloud.points[3].scanline, 1U);
    EXPECT_NEAR(cloud.points[3].time_s - cloud.points[0].time_s, 1e-3, 1e-9);  // the counter began anew
  }
}

TEST(Lms, Refusals) {
  const std::string good = one_scan(5, {1000, 2000});
  EXPECT_EQ(session_refusal(tshark_json({good})), "accepted");
  EXPECT_EQ(session_refusal("").rfind("s.json: packets", 0), 0U);
  EXPECT_EQ(session_refusal("{}").rfind("s.json: packets", 0), 0U);
  EXPECT_EQ(session_refusal("[1, null, {\"_source\": []}]").rfind("s.json: scans", 0), 0U);
  EXPECT_NE(session_refusal(R"([{"_source":{"layers":{"tcp":{"tcp.payload":"02:0"}}}}])").find("tcp.payload"), std::string::npos);
  EXPECT_NE(session_refusal(R"([{"_source":{"layers":{"tcp":{"tcp.payload":7}}}}])").find("tcp.payload"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({good.substr(0, good.size() - 1)})).find("ends within"), std::string::npos);
  std::string bad = good;
  bad.back() = static_cast<char>(bad.back() ^ 1);
  EXPECT_NE(session_refusal(tshark_json({bad})).find("checksum"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({good + "\x03\x02\x02\x02" + std::string(20, '\0')})).find("frame"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({good + std::string("\2\2\2\2\x05\xF5\xE1\x00", 8)})).find("100000000 bytes claimed"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({one_scan(9, {1000}) + one_scan(8, {1000})})).find("runs backwards"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({cola_b(lmd_scandata(1, {{"DIST1", 0x7FC00000, 0, 5000, {1}}}, {}))})).find("scale factor"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({cola_b(lmd_scandata(1, {{"DIST1", 0x447A0000, 0, 5000, {65535}}}, {}))})).find("distance"), std::string::npos);
  EXPECT_NE(session_refusal(tshark_json({cola_b(lmd_scandata(1, {{"RSSI1", 0x3F800000, 0, 5000, {1}}}, {}))})).find("no distances"), std::string::npos);
  const std::string body = lmd_scandata(1, {{"DIST1", 0x3F800000, 0, 5000, {1000, 2000}}}, {});
  for (std::size_t size = 16; size + 30 < body.size(); ++size)
    EXPECT_EQ(session_refusal(tshark_json({cola_b(body.substr(0, size))})).rfind("s.json: LMDscandata", 0), 0U) << size;
}

TEST(RealRecordings, VelodyneCaptureMeetsItsOriginsDecoding) {
  const std::string path = real_data("vlp16_dual_return/vlp16_dual_return.pcap");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const auto cloud = read_recording(path);
  EXPECT_EQ(cloud.format, "pcap");
  EXPECT_GT(cloud.points.size(), 50000U);
  EXPECT_LE(cloud.points.back().scanline, 603U * 12U);
  EXPECT_NEAR(cloud.points.back().time_s - cloud.points.front().time_s, 0.4, 0.02);
  // Points of the origin's sweep are found among ours; its frame is turned by 90 degrees (x to the right of y).
  const auto reference = read_recording(real_data("vlp16_dual_return/reference_sweep.pcd"));
  std::size_t checked = 0, found = 0;
  for (std::size_t i = 0; i < reference.points.size(); i += 97) {
    const ScanPoint& r = reference.points[i];
    const double range = std::hypot(r.x, r.y, r.z), up = std::asin(static_cast<double>(r.z) / range);
    ++checked;
    for (const ScanPoint& p : cloud.points) {
      const double ours = std::hypot(p.x, p.y, p.z);
      if (std::abs(ours - range) < 0.003 && std::abs(std::asin(static_cast<double>(p.z) / ours) - up) < 1e-3) {
        ++found;
        break;
      }
    }
  }
  EXPECT_GT(found, checked / 2);  // the nearer returns of pairs are in the reference as well, and not in ours
}

TEST(RealRecordings, LaserSession) {
  const std::string path = real_data("lms111/20210302_lms111.pcapng.json");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: no " << path << " (BERM_REAL_DATA)";
  const auto cloud = read_recording(path);
  EXPECT_EQ(cloud.format, "lms");
  EXPECT_EQ(cloud.points.back().scanline, 174U);
  EXPECT_GT(cloud.points.size(), 175U * 500U);
  EXPECT_NEAR((cloud.points.back().time_s - cloud.points.front().time_s) / 174.0, 0.02, 0.001);  // 50 Hz
  for (const ScanPoint& p : cloud.points) ASSERT_LT(std::hypot(p.x, p.y), 2.0F);
}

}  // namespace
}  // namespace berm::app

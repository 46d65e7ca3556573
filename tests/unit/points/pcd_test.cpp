#include "points/pcd.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "points/file_bytes.hpp"
#include "points/lzf.hpp"
#include "sample_files.hpp"
#include "scratch.hpp"

namespace berm::app {
namespace {

using test::pcd_header;

// The one line of the refusal.
std::string refusal(const std::string& bytes) {
  try {
    parse_pcd(bytes, "file.pcd");
  } catch (const PointFileError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& bytes, const std::string& field) {
  const std::string line = refusal(bytes);
  EXPECT_EQ(line.rfind("file.pcd: " + field, 0), 0U) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

TEST(Pcd, AsciiWithOtherFieldsBetween) {
  const auto cloud = parse_pcd("VERSION 0.7\nFIELDS rgb x n y z\nSIZE 4 4 4 4 4\nTYPE U F F F F\nCOUNT 1 1 3 1 1\nWIDTH 1\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\n"
                               "POINTS 2\nDATA ascii\n9 1.5 7 7 7 -2 3e1\n9 4 7 7 nan 5 6\n", "a");
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0].x, 1.5F);
  EXPECT_EQ(cloud.points[0].y, -2.0F);
  EXPECT_EQ(cloud.points[0].z, 30.0F);
  EXPECT_EQ(cloud.points[1].z, 6.0F);
  EXPECT_FALSE(cloud.scanlines);
  EXPECT_EQ(cloud.points[1].scanline, 0U);
  EXPECT_EQ(cloud.points[1].time_s, 0.0);
  EXPECT_EQ(cloud.viewpoint, (std::array<double, 3>{1, 2, 3}));
}

TEST(Pcd, WhatIsWrittenIsRead) {
  const berm::test::Scratch scratch;
  const auto path = scratch.path("round_trip.pcd");
  EXPECT_TRUE(rc::check("round trip", [&] {
    std::vector<ScanPoint> points;
    std::uint32_t scanline = 0;
    for (int i = *rc::gen::inRange(0, 40); i > 0; --i) {
      scanline += *rc::gen::inRange(0U, 3U);
      const auto place = [] { return static_cast<float>(*rc::gen::inRange(-1000000, 1000000)) * 1e-3F; };
      points.push_back({place(), place(), place(), scanline, scanline * 0.025});
    }
    write_pcd(path, points, {1.5, -2.25, 3.0});
    const auto cloud = read_pcd_cloud(path);
    RC_ASSERT(cloud.viewpoint == (std::array<double, 3>{1.5, -2.25, 3.0}));
    RC_ASSERT(cloud.scanlines);
    RC_ASSERT(cloud.points.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ScanPoint &p = points[i], &q = cloud.points[i];
      RC_ASSERT(p.x == q.x && p.y == q.y && p.z == q.z && p.scanline == q.scanline && p.time_s == q.time_s);
    }
  }));
}

// Control bytes by hand: runs of bytes as they are, short and long repetitions, one that overlaps what it writes.
TEST(Pcd, LzfByHand) {
  EXPECT_EQ(lzf_decompress(std::string("\x02" "abc" "\x20\x02" "\xE0\x04\x00", 9), 3 + 3 + 13), "abcabc" + std::string(13, 'c'));
  EXPECT_FALSE(lzf_decompress(std::string("\x02" "ab", 3), 3));        // the run ends early
  EXPECT_FALSE(lzf_decompress(std::string("\x00" "a" "\x20\x01", 4), 4));  // before the beginning
  EXPECT_FALSE(lzf_decompress(std::string("\x00" "a" "\xE0\xFF\x00", 5), 100));  // longer than claimed
  EXPECT_FALSE(lzf_decompress(std::string("\x00" "a", 2), 2));         // shorter than claimed
}

TEST(Pcd, CompressedIsFieldByField) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary_compressed\n";
  std::string raw;
  for (const float v : {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}) {
    std::uint32_t bits;
    std::memcpy(&bits, &v, 4);
    test::put32(raw, bits);
  }
  std::string data;
  test::put32(data, static_cast<std::uint32_t>(raw.size() + 1));
  test::put32(data, static_cast<std::uint32_t>(raw.size()));
  data += static_cast<char>(raw.size() - 1);
  data += raw;
  const auto cloud = parse_pcd(head + data, "c");
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0].y, 3.0F);
  EXPECT_EQ(cloud.points[1].x, 2.0F);
  EXPECT_EQ(cloud.points[1].z, 6.0F);
  expect_refused(head + data.substr(0, data.size() - 1), "DATA");
  expect_refused(head + data.substr(0, 5), "DATA");
  std::string claims = data;
  std::memcpy(claims.data() + 4, "\xFF\xFF\xFF\xFF", 4);
  expect_refused(head + claims, "DATA");
  expect_refused(head + data + "x", "DATA");
}

TEST(Pcd, ARefusalQuotesLittleOfTheFile) {
  const std::string word(5000, 'k'), most = std::string(60, 'k') + "...";
  EXPECT_EQ(refusal(word + " 1\n" + word + " 2\n"), "file.pcd: " + most + ": is given twice");
  EXPECT_EQ(refusal("\x1b[2J 1\n\x1b[2J 2\n"), "file.pcd: ?[2J: is given twice");
  const std::string name(3000, 'k'), rest = "\nSIZE 4 4 4 4 4\nTYPE F F F F F\nWIDTH 0\nHEIGHT 0\nDATA ascii\n";
  EXPECT_EQ(refusal("FIELDS x y z " + name + " " + name + rest), "file.pcd: FIELDS: " + most + " is given twice");
  EXPECT_EQ(refusal("FIELDS x y z a\x1b a\x1b" + rest), "file.pcd: FIELDS: a? is given twice");
  expect_refused("FIELDS " + std::string(3'000'000, 'x') + rest, "header: ends before its DATA line, or a line is longer than 8192 bytes");
}

TEST(Pcd, RefusalsNameFileFieldAndLimit) {
  expect_refused("", "header");
  expect_refused("VERSION 0.7\n", "header");
  expect_refused(pcd_header("-1", "ascii"), "WIDTH");
  expect_refused(pcd_header("1000000000000", "ascii"), "WIDTH");
  expect_refused(pcd_header("100000000", "ascii") + "1 2 3 0 0\n", "POINTS");
  expect_refused(pcd_header("100000000", "binary") + "1234", "POINTS");
  expect_refused(pcd_header("1", "zipped"), "DATA");
  expect_refused(pcd_header("1", "ascii") + "1 2 three 0 0\n", "z");
  expect_refused(pcd_header("1", "ascii") + "nan 2 3 0 0\n", "x");
  expect_refused(pcd_header("1", "ascii") + "1 1e300 3 0 0\n", "y");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 -1 0\n", "scanline");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 1.5 0\n", "scanline");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 0 inf\n", "time");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 0 1e300\n", "time");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 0 -1.1e10\n", "time");
  expect_refused(pcd_header("1", "binary") + std::string(25, '\0'), "POINTS");
  expect_refused(pcd_header("0", "binary") + "x", "POINTS");
  for (const char* turn : {"0 0 0 0", "2 0 0 0", "0.7071 0 0 0.7071", "nan 0 0 0", "1 0 0 x", "1 0 0 0.01"})
    expect_refused(pcd_header("0", "ascii", "VIEWPOINT 0 0 0 " + std::string(turn) + "\n"), "VIEWPOINT");
  EXPECT_EQ(refusal(pcd_header("0", "ascii", "VIEWPOINT 0 0 0 -1 0 -0.0 1e-9\n")), "accepted");
  expect_refused(pcd_header("2", "ascii") + "1 2 3 5 0\n1 2 3 4 0\n", "scanline");
  expect_refused(pcd_header("2", "ascii") + "1 2 3 5 1\n1 2 3 5 0.5\n", "time");
  expect_refused(pcd_header("1", "ascii") + "1 2 3 0 0\n1 2 3 0 0\n", "POINTS");
  expect_refused(pcd_header("1", "ascii", "WIDTH 3\n"), "WIDTH");
  expect_refused("FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 0\nHEIGHT 0\nDATA ascii\n", "FIELDS");
  expect_refused("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 0\nHEIGHT 0\nDATA ascii\n", "SIZE");
  expect_refused("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 100000\nWIDTH 0\nHEIGHT 0\nDATA ascii\n", "COUNT");
  EXPECT_EQ(refusal(pcd_header("1", "ascii") + "1 2 3 0 0\n"), "accepted");
  EXPECT_EQ(refusal(pcd_header("0", "binary")), "accepted");
}

TEST(Pcd, NoFileAndNoRoom) {
  EXPECT_THROW(read_pcd("/no/such/file.pcd"), PointFileError);
  EXPECT_THROW(read_pcd(berm::test::Scratch().folder()), PointFileError);
  EXPECT_THROW(write_pcd("/no/such/folder/x.pcd", {}), PointFileError);
  EXPECT_THROW(read_file_bytes("/dev/zero", 1 << 20), PointFileError);
}

TEST(Pcd, RealFiles) {
  const std::string terrain = test::real_data("site_terrain/terrain_xyz.pcd");
  if (!std::filesystem::exists(terrain)) GTEST_SKIP() << "SKIPPED: no " << terrain << " (BERM_REAL_DATA)";
  EXPECT_EQ(read_pcd(terrain).size(), 56758U);
  EXPECT_EQ(read_pcd(terrain)[0].y, 48.426F);
  const auto sweep = read_pcd(test::real_data("vlp16_dual_return/reference_sweep.pcd"));
  EXPECT_EQ(sweep.size(), 14831U);
  for (const ScanPoint& p : sweep) EXPECT_LT(std::hypot(p.x, p.y, p.z), 20.0F);
}

}  // namespace
}  // namespace berm::app

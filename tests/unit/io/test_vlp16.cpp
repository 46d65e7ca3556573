// The VLP-16 decoder against a real recording and the points its origin decoded from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "io/vlp16.hpp"
#include "recording.hpp"

namespace berm::kernel {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct ReferencePoint {
  float x, y, z;
  std::uint8_t intensity, return_type;
  std::uint16_t channel;
  float azimuth_rad, elevation_rad, distance_m;
  std::uint32_t time_ns;
};
static_assert(sizeof(ReferencePoint) == 32, "as in the file");

constexpr std::uint8_t kIdenticalReturns = 6;  // the two blocks agree: first is last

std::vector<ReferencePoint> reference_points() {
  const auto file = test::bytes_of(test::vlp16_recording("reference_sweep.pcd"));
  const std::string text(file.begin(), file.end());
  const std::size_t data = text.find("DATA binary\n");
  std::vector<ReferencePoint> points;
  if (data == std::string::npos) return points;
  for (std::size_t at = data + 12; at + 32 <= file.size(); at += 32) points.push_back(test::read_at<ReferencePoint>(&file[at]));
  return points;
}

double turn_difference_deg(double a, double b) { return std::fabs(std::remainder(a - b, 360.0)); }

class Vlp16Recording : public ::testing::Test {
 protected:
  void SetUp() override {
    packets = test::payloads(test::bytes_of(test::vlp16_recording("vlp16_dual_return.pcap")));
    if (packets.empty()) GTEST_SKIP() << "SKIPPED: no recording at " << test::vlp16_recording("vlp16_dual_return.pcap");
  }
  std::vector<std::vector<std::uint8_t>> packets;
};

// verifies: SK-CY-50
TEST_F(Vlp16Recording, EveryPointOfTheReferenceSweepIsThere) {
  using Key = std::pair<int, int>;  // channel, range in steps of 2 mm
  std::map<Key, std::vector<double>> azimuths_deg;
  Vlp16Packet packet{};
  int decoded = 0;
  for (const auto& bytes : packets) {
    ASSERT_EQ(vlp16_decode(bytes.data(), bytes.size(), packet), Vlp16Result::kOk);
    decoded += packet.count;
    for (int i = 0; i < packet.count; ++i) azimuths_deg[{packet.point[i].channel, packet.point[i].range_mm / 2}].push_back(packet.point[i].azimuth_mdeg * 1e-3);
  }
  EXPECT_GT(decoded, 50000);
  const auto reference = reference_points();
  ASSERT_EQ(reference.size(), 14831U);
  int compared = 0, close = 0, missing = 0;
  for (const auto& point : reference) {
    if (point.return_type != kIdenticalReturns) continue;
    ++compared;
    const double azimuth_deg = point.azimuth_rad * 180.0 / kPi;
    double nearest_deg = 360.0;
    // distance within 2 mm: the step itself and those beside it
    const int step = static_cast<int>(std::lround(point.distance_m * 500.0));
    for (int s = step - 1; s <= step + 1; ++s) {
      const auto found = azimuths_deg.find({point.channel, s});
      if (found == azimuths_deg.end()) continue;
      for (const double a : found->second) nearest_deg = std::min(nearest_deg, turn_difference_deg(a, azimuth_deg));
    }
    missing += nearest_deg > 0.45 ? 1 : 0;  // the reference does not interpolate inside the last firings of a packet
    close += nearest_deg < 0.02 ? 1 : 0;
  }
  EXPECT_GT(compared, 14000);
  EXPECT_EQ(missing, 0);
  EXPECT_GT(close, compared * 8 / 10);
}

// verifies: SK-CY-51
TEST_F(Vlp16Recording, OfTwoReturnsTheFartherIsTaken) {
  Vlp16Packet packet{};
  int differing = 0;
  for (const auto& bytes : packets) {
    ASSERT_EQ(vlp16_decode(bytes.data(), bytes.size(), packet), Vlp16Result::kOk);
    int at = 0;
    for (int block = 0; block < 12; block += 2) {
      for (int shot = 0; shot < 32; ++shot) {
        const std::size_t even = static_cast<std::size_t>(block * 100 + 4 + 3 * shot);
        const int a = test::read_at<std::uint16_t>(&bytes[even]) * 2, b = test::read_at<std::uint16_t>(&bytes[even + 100]) * 2;
        const int farther = std::max(a, b);
        if (farther < kVlp16RangeMinMm) continue;
        ASSERT_LT(at, packet.count);
        ASSERT_EQ(packet.point[at].range_mm, farther);
        differing += a != b ? 1 : 0;
        ++at;
      }
    }
    ASSERT_EQ(at, packet.count);
  }
  EXPECT_GT(differing, 500);
}

// verifies: SK-CY-52
TEST_F(Vlp16Recording, TruncatedAndForeignPacketsAreRefusedAndChangeNothing) {
  const auto good = packets[10];
  Vlp16Packet packet{};
  ASSERT_EQ(vlp16_decode(good.data(), good.size(), packet), Vlp16Result::kOk);
  const Vlp16Packet before = packet;
  for (std::size_t size = 0; size < good.size(); ++size) ASSERT_EQ(vlp16_decode(good.data(), size, packet), Vlp16Result::kSize);
  auto longer = good;
  longer.push_back(0);
  EXPECT_EQ(vlp16_decode(longer.data(), longer.size(), packet), Vlp16Result::kSize);
  for (int value = 0; value < 256; ++value) {
    auto foreign = good;
    foreign[1204] = static_cast<std::uint8_t>(value);
    if (value < 0x37 || value > 0x39) {
      ASSERT_EQ(vlp16_decode(foreign.data(), foreign.size(), packet), Vlp16Result::kMode) << value;
    }
    foreign = good;
    foreign[1205] = static_cast<std::uint8_t>(value);
    if (value != 0x22) {
      ASSERT_EQ(vlp16_decode(foreign.data(), foreign.size(), packet), Vlp16Result::kProduct) << value;
    }
  }
  for (int block = 0; block < 12; ++block) {
    auto damaged = good;
    damaged[static_cast<std::size_t>(block * 100)] ^= 1U;
    EXPECT_EQ(vlp16_decode(damaged.data(), damaged.size(), packet), Vlp16Result::kFlag);
    damaged = good;
    damaged[static_cast<std::size_t>(block * 100 + 3)] = 0x8D;  // 36096 and more
    EXPECT_EQ(vlp16_decode(damaged.data(), damaged.size(), packet), Vlp16Result::kAzimuth);
  }
  EXPECT_EQ(std::memcmp(&packet, &before, sizeof packet), 0);
}

// verifies: SK-CY-53
TEST(Vlp16, PointsStandWhereTheMountPutsThem) {
  const Vlp16Mount mount{1.0, 2.0, 3.0, kPi / 2};
  const sk_point ahead = vlp16_project(mount, {8, 0, 0, 10000}).left;  // elevation 1 degree, azimuth 0: along the sensor's x, here base y
  EXPECT_NEAR(ahead.x_mm, 1000, 1);
  EXPECT_NEAR(ahead.y_mm, 2000 + 10000 * std::cos(kPi / 180), 1);
  EXPECT_EQ(ahead.z_mm, 3000 + static_cast<int>(std::ceil(10000 * std::sin(kPi / 180))));
  const sk_point aside = vlp16_project(mount, {8, 90000, 0, 10000}).right;  // clockwise from above: to the sensor's right, here base x
  EXPECT_NEAR(aside.x_mm, 1000 + 10000 * std::cos(kPi / 180), 1);
  EXPECT_NEAR(aside.y_mm, 2000, 1);
}

// Every channel, all round, with the widest spread: both edges where plain trigonometry puts them.
// verifies: SK-CY-53, SK-CY-54
TEST(Vlp16, EveryChannelsEdgesAreThoseOfPlainTrigonometry) {
  const Vlp16Mount mount{1.0, -2.0, 3.0, 0.7};
  for (std::uint8_t channel = 0; channel < kVlp16Channels; ++channel)
    for (std::uint32_t azimuth = 0; azimuth < 360000; azimuth += 1234)
      for (const std::uint32_t spread : {0U, 286U, 1086U}) {
        constexpr std::int32_t kRange = 100000;
        const Vlp16Footprint f = vlp16_project(mount, {channel, azimuth, spread, kRange});
        const double elevation = (2.0 * channel - 15.0) * kPi / 180.0, level = kRange * std::cos(elevation);
        const double left = 0.7 - (azimuth * 1e-3 - spread * 1e-3) * kPi / 180.0, right = 0.7 - (azimuth * 1e-3 + spread * 1e-3) * kPi / 180.0;
        ASSERT_NEAR(f.left.x_mm, 1000 + level * std::cos(left), 0.501);
        ASSERT_NEAR(f.left.y_mm, -2000 + level * std::sin(left), 0.501);
        ASSERT_NEAR(f.right.x_mm, 1000 + level * std::cos(right), 0.501);
        ASSERT_NEAR(f.right.y_mm, -2000 + level * std::sin(right), 0.501);
        ASSERT_NEAR(f.left.z_mm, 3000.5 + kRange * std::sin(elevation), 0.501);
      }
}

// verifies: SK-CY-54
TEST(Vlp16, AFootprintIsAsWideAsTheBeamAndOneFiringsTurn) {
  const Vlp16Footprint f = vlp16_project(Vlp16Mount{}, {8, 0, 286, 10000});
  EXPECT_NEAR(f.left.y_mm, 49.9, 1);  // 10 m, 0.286 degrees: half of 3 mrad and 0.2 degrees
  EXPECT_NEAR(f.right.y_mm, -49.9, 1);
  EXPECT_EQ(f.left.z_mm, f.right.z_mm);
}

// verifies: SK-CY-54
TEST_F(Vlp16Recording, TheSpreadOfARecordedReturnIsThatOfTenTurnsASecond) {
  Vlp16Packet packet{};
  ASSERT_EQ(vlp16_decode(packets[10].data(), packets[10].size(), packet), Vlp16Result::kOk);
  for (int i = 0; i < packet.count; ++i) EXPECT_NEAR(packet.point[i].spread_mdeg, 86 + 200, 15) << i;
}

}  // namespace
}  // namespace berm::kernel

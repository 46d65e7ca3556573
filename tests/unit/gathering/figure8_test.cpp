// The four pictures of zolynski-2012, Figure 8: a wall behind a box; the box away; the box there again; the box moved.
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>

#include "gathering/gather_picture.hpp"
#include "scanned_room.hpp"

namespace berm::app {
namespace {

using namespace test;

const Box kFirst{{2.4, -0.5, 0.3}, {2.9, 0.1, 1.9}}, kMoved{{2.4, 0.5, 0.3}, {2.9, 1.1, 1.9}};

bool between(double v, double low, double high) { return v >= low && v <= high; }

// Points on a box or within it; the cross-section is 1 m above the ground.
std::size_t on_box(const std::vector<ScanPoint>& points, const Box& box) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const ScanPoint& p) {
    const double x = static_cast<double>(p.x), y = static_cast<double>(p.y), z = static_cast<double>(p.z);
    return between(x, box.low.x() - 0.1, box.high.x() + 0.1) && between(y, box.low.y() - 0.1, box.high.y() + 0.1) &&
           between(z, box.low.z(), box.high.z());
  }));
}

// Which tenths of a metre of the wall, in a band of 0.6 m about the cross-section, have a point.
std::set<int> wall_seen(const std::vector<ScanPoint>& points, double low_y, double high_y) {
  std::set<int> cells;
  for (const ScanPoint& p : points) {
    const double y = static_cast<double>(p.y);
    if (std::abs(static_cast<double>(p.x) - ScannedRoom::kWall) < 0.15 && std::abs(static_cast<double>(p.z) - 1.0) < 0.3 && between(y, low_y, high_y))
      cells.insert(static_cast<int>(std::floor(y * 10.0)));
  }
  return cells;
}

// What of the cloud a written picture shows: its coloured dots, whose x and y lie within bounds. The paper and the grid are grey.
class WrittenPicture {
public:
  WrittenPicture(const std::string& path, const PictureView& view) : view_(view) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return;
    image.format = PNG_FORMAT_RGB;
    width_ = image.width;
    pixels_.resize(std::size_t{image.width} * image.height);
    if (png_image_finish_read(&image, nullptr, pixels_.data(), 0, nullptr) == 0) pixels_.clear();
  }
  std::size_t dots(double low_x, double high_x, double low_y, double high_y) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      if (pixels_[i][0] == pixels_[i][1] && pixels_[i][1] == pixels_[i][2]) continue;
      const double metres = (view_.high_x - view_.low_x) / static_cast<double>(width_);
      const double x = view_.low_x + metres * static_cast<double>(i % width_), y = view_.high_y - metres * static_cast<double>(i / width_);
      count += between(x, low_x, high_x) && between(y, low_y, high_y) ? 1 : 0;
    }
    return count;
  }

private:
  PictureView view_;
  std::size_t width_ = 1;
  std::vector<std::array<std::uint8_t, 3>> pixels_;  // none: it was not written, or is no PNG
};

const PictureView kView{-0.5, -3.0, 4.5, 3.0};

std::string picture_path(int number) { return std::string(BERM_PICTURES) + "/gathering_figure8_" + std::to_string(number) + ".png"; }

class Figure8 : public testing::Test {
protected:
  Figure8() : room_(8), chains_(two_scanners()), gatherer_(GatheringOptions{}) {
    for (const KinematicChain& chain : chains_) gatherer_.add_scanner({0.01, 0.001, 0.002}, chain);
  }

  std::vector<ScanPoint> next_picture(std::optional<Box> box, int number) {
    room_.box = box;
    sweep(gatherer_, room_, chains_, number % 2 == 1 ? -0.8 : 0.8, number % 2 == 1 ? 0.8 : -0.8, 0.008, time_s_);
    const auto points = gatherer_.points();
    std::vector<ScanPoint> section;
    for (const ScanPoint& p : points)
      if (std::abs(p.z - 1.0F) < 0.1F) section.push_back(p);
    std::filesystem::remove(picture_path(number));
    write_cloud_picture(picture_path(number), section, kView);
    return points;
  }

  ScannedRoom room_;
  std::vector<KinematicChain> chains_;
  PointCloudGatherer gatherer_;
  double time_s_ = 0.0;
};

TEST_F(Figure8, BoxThereAwayThereAgainMoved) {
  // Behind the first box, as seen from the axis: y from -0.83 to 0.17 at the wall; here what both scanners cannot see.
  constexpr double kLow = -0.6, kHigh = 0.0;
  const auto first = next_picture(kFirst, 1);
  EXPECT_GT(on_box(first, kFirst), 200U);
  EXPECT_EQ(wall_seen(first, kLow, kHigh).size(), 0U);
  EXPECT_GE(wall_seen(first, -2.0, -1.5).size(), 5U);

  const auto second = next_picture(std::nullopt, 2);
  EXPECT_EQ(on_box(second, kFirst), 0U);
  const auto wall = wall_seen(second, kLow, kHigh);
  EXPECT_GE(wall.size(), 6U);

  const auto third = next_picture(kFirst, 3);
  EXPECT_GT(on_box(third, kFirst), 200U);
  EXPECT_EQ(wall_seen(third, kLow, kHigh), wall);  // covered, not forgotten

  const auto fourth = next_picture(kMoved, 4);
  EXPECT_EQ(on_box(fourth, kFirst), 0U);
  EXPECT_GT(on_box(fourth, kMoved), 200U);
  EXPECT_EQ(wall_seen(fourth, kLow, kHigh), wall);
  EXPECT_GE(wall_seen(fourth, 1.0, 1.5).size(), 5U);  // behind the moved box
  const GatheringCounts counts = gatherer_.counts();
  printf("%llu points in, %zu kept, %llu merged, %llu deleted\n", static_cast<unsigned long long>(counts.points_in), gatherer_.store().size(),
         static_cast<unsigned long long>(counts.merged), static_cast<unsigned long long>(counts.deleted));
  EXPECT_GT(counts.merged, counts.points_in / 4);

  // The four pictures are there to be looked at, and show it.
  for (int number = 1; number <= 4; ++number) {
    const WrittenPicture picture(picture_path(number), kView);
    const auto shows = [&picture](const Box& box) {
      return picture.dots(box.low.x() - 0.1, box.high.x() + 0.1, box.low.y() - 0.1, box.high.y() + 0.1);
    };
    EXPECT_GT(picture.dots(ScannedRoom::kWall - 0.2, ScannedRoom::kWall + 0.2, -3.0, 3.0), 500U) << "no wall in " << picture_path(number);
    const std::size_t first_box = shows(kFirst), moved_box = shows(kMoved);
    EXPECT_EQ(first_box > 200U, number == 1 || number == 3) << first_box << " dots in " << picture_path(number);
    EXPECT_EQ(moved_box > 200U, number == 4) << moved_box << " dots in " << picture_path(number);
  }
}

// Nothing moves: next to nothing is deleted, and the cloud does not grow for ever.
TEST_F(Figure8, AStillRoomStays) {
  next_picture(kFirst, 1);
  const std::size_t once = gatherer_.store().size();
  for (int i = 0; i < 4; ++i) sweep(gatherer_, room_, chains_, i % 2 == 0 ? 0.8 : -0.8, i % 2 == 0 ? -0.8 : 0.8, 0.008, time_s_);
  const GatheringCounts counts = gatherer_.counts();
  printf("%zu points after one sweep, %zu after five, %llu deleted of %llu\n", once, gatherer_.store().size(),
         static_cast<unsigned long long>(counts.deleted), static_cast<unsigned long long>(counts.points_in));
  EXPECT_LT(counts.deleted, counts.points_in / 50);
  EXPECT_LT(gatherer_.store().size(), 2 * once);
  // The wall is where it is: the mean of what was merged is nearer than a single measurement.
  double squares = 0.0;
  std::size_t count = 0;
  for (const ScanPoint& p : gatherer_.points())
    if (p.x > 3.8F) {
      squares += std::pow(static_cast<double>(p.x) - ScannedRoom::kWall, 2);
      ++count;
    }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.012);
}

}  // namespace
}  // namespace berm::app

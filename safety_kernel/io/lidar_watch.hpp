// What a lidar on the upper body sees, into its Workspace Monitor.
//
// A level VLP-16 sees the ground in rings: with its head 1.1 m up at 4.1, 4.8, 5.7, 6.9, 9, 12.6 and 21 m. A cell between two rings is never hit,
// and a rise beside cells that nobody saw is no obstacle. So, as between two samples of a scanline (leger-1998, section 3.1), the line from one
// laser's return to the next laser's is an interpolated height; and that from the lidar to the nearest return too, since the beam met nothing on
// it.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "geometry/kinematics.hpp"
#include "geometry/self_filter.hpp"
#include "io/lidar_mount.hpp"
#include "io/monitor_watch.hpp"
#include "io/vlp16.hpp"

namespace berm::kernel {

// Returns of one packet that count, by the base frame.
struct LidarReturns {
  static constexpr int kCapacity = kVlp16MaxPoints;
  struct Return {
    sk_point head, point;
    bool lined;  // of a bearing in which lines are drawn
  };
  int count = 0;
  Return hit[kCapacity];
};

class LidarWatch {
 public:
  // Of the firings every second is taken, of 0.2 degrees at ten turns a second: 0.10 m at 15 m, so that a child 0.4 m wide gets three, and two of
  // them in one cell, whose highest is discarded.
  static constexpr int kTaken = 2;
  // A return counts if the firing taken before or after has one of the same laser that is as far away, within spurious_range; where the next laser
  // above or below meets something upright, nearer than the first of these, both must have, within the second. So neither does a spurious return,
  // nor the side of a thing that is met at a grazing angle: of that a turn gives now this cell a return and now that one, and each would be a rise.
  static constexpr std::int32_t kUprightMm = 300, kBesideUprightMm = 150;
  static constexpr std::uint32_t kGapMdeg = 1000;  // firings farther apart have no firing between them to be compared with
  // Lines are drawn in bearings this far apart, 0.21 m at 15 m, so that no cell between two is left out; every fourth of them in a turn, then the
  // next.
  static constexpr std::uint32_t kLineMdeg = 800;
  static constexpr std::uint32_t kTurnsOfLines = 4;
  static constexpr std::int64_t kWaitUs = 3000;  // from a firing to the end of the packet after its own, which it may wait for

  LidarWatch(const berm_parameters& parameters, int lidar);

  void begin();
  // joints: at the time of the packet, which lasts 1.3 ms: at 50 degrees/s the swing turns by 0.07 degrees in it, 17 mm at 15 m.
  void take(const Vlp16Packet& packet, const JointAngles& joints, std::int64_t now_us, const MonitorWatch::Others& others);

  // Of the newest packet taken, the last firing of the one before it for the last of its own.
  const LidarReturns& returns() const { return returns_; }
  MonitorWatch& monitor() { return monitor_; }
  const MonitorWatch& monitor() const { return monitor_; }

 private:
  struct Pose {
    ImplementPose implements;
    double cosine, sine;  // of the swing
    sk_point head;        // base frame
  };
  enum class Met : std::uint8_t { kNothing, kOwn, kThing };
  struct Column {  // of one firing, by rising elevation
    std::uint32_t azimuth_mdeg = 0;
    Met met[kVlp16Channels] = {};
    std::int32_t range_mm[kVlp16Channels] = {};
    std::int32_t level_mm[kVlp16Channels] = {};  // range in the sensor's level plane
    sk_point point[kVlp16Channels] = {};
    sk_point head{};
  };
  bool draws_lines(std::uint32_t azimuth_mdeg);
  void see(const Vlp16Return* hit, int count, const Pose& pose, Column& column) const;
  bool counts(const Column& column, int channel, const Column* before, const Column* after) const;
  void insert(const Column& column, const bool (&counting)[kVlp16Channels], const MonitorWatch::Others& others, std::int64_t now_us);
  void note(const Column& column, const bool (&counting)[kVlp16Channels], bool lined);
  void finish(const Column& column, const Column* before, const Column* after, const MonitorWatch::Others& others, std::int64_t now_us);
  void draw(const Column& column, std::int64_t now_us);
  void draw_nearest(const sk_point& head, const sk_point& nearest, std::int64_t now_us);
  void draw_line(const sk_point& from, const sk_point& to, std::int64_t now_us);

  LidarMount mount_;
  SelfFilter self_;
  std::int32_t rise_mm_, spurious_mm_;
  MonitorWatch monitor_;
  LidarReturns returns_;
  Column newest_[3];                   // columns of the newest firings, turn about
  std::uint32_t columns_ = 0;          // that there were since begin()
  std::uint32_t line_ = 0, turn_ = 0;  // newest bearing and turn in which lines were drawn or left out
};

}  // namespace berm::kernel

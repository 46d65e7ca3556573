// The gathered points: contiguous arrays, found by place through a hash of blocks of 4 x 4 x 4 voxels.
// No allocation for a point: arrays grow by halves.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gathering/error_ellipsoid.hpp"

namespace berm::app {

struct GatheredPoint {
  float x, y, z;          // metres, the cloud's frame
  Covariance covariance;  // of its place
  std::uint32_t scan;     // the latest that measured it: number over all scanners
  std::uint32_t next;     // in its voxel, or in the list of free places
};

class CloudStore {
public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr int kEdge = 4;  // voxels along a block

  struct Block {
    std::array<std::int32_t, 3> key;
    std::uint64_t occupied;  // one bit a voxel
    float widest;            // standard deviation along an axis, metres: no point has had a larger one here
    std::array<std::uint32_t, kEdge * kEdge * kEdge> first;
  };

  // capacity: the largest number of points, at least 1 and less than 2^32 - 1.
  CloudStore(double voxel_m, std::size_t capacity);

  // Places must be within 1e6 m. When the store is full, points of the lowest epochs are removed first, a batch at a time (zolynski-2012, 2.7).
  std::uint32_t insert(const GatheredPoint& point, std::uint32_t epoch);
  void move(std::uint32_t index, const GatheredPoint& point, std::uint32_t epoch);
  void remove(std::uint32_t index);

  // visit(index) for every point within half + quantile standard deviations of itself of the place along each axis, and for some beyond; none has more
  // than widest, in metres. Each block is searched as far as its own points reach: what is uncertain far out does not make the search near by any longer.
  template <typename Visit>
  void for_each_near(const Vector3& place, const Vector3& half, double quantile, double widest, Visit visit) const;

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t overflowed() const { return overflowed_; }  // removed for want of room
  std::size_t bytes() const;
  const GatheredPoint& operator[](std::uint32_t index) const { return points_[index]; }
  std::uint32_t epoch(std::uint32_t index) const { return epochs_[index]; }
  bool used(std::uint32_t index) const { return epochs_[index] != 0; }  // epochs count from 1
  std::size_t places() const { return points_.size(); }                 // used and free
  double voxel_m() const { return voxel_; }
  double block_m() const { return voxel_ * kEdge; }

  const std::vector<Block>& blocks() const { return blocks_; }
  const Block* block(std::int32_t x, std::int32_t y, std::int32_t z) const;
  std::int32_t voxel_of(double place) const { return static_cast<std::int32_t>(std::floor(place * inverse_voxel_)); }

private:
  std::size_t slot_of(const std::array<std::int32_t, 3>& key) const;
  std::uint32_t make_block(const std::array<std::int32_t, 3>& key);
  void drop_block(std::uint32_t number);
  void rehash(std::size_t slots);
  void link(std::uint32_t index);
  void unlink(std::uint32_t index);
  void make_room();

  double voxel_, inverse_voxel_;
  std::size_t capacity_, size_ = 0, overflowed_ = 0;
  std::vector<GatheredPoint> points_;
  std::vector<std::uint32_t> epochs_;
  std::uint32_t free_ = kNone;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> slots_;  // numbers of blocks, by linear probing
};

template <typename Visit>
void CloudStore::for_each_near(const Vector3& place, const Vector3& half, double quantile, double widest, Visit visit) const {
  std::array<std::int32_t, 3> from, to;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = voxel_of(place[i] - half[i] - quantile * widest) >> 2;
    to[i] = voxel_of(place[i] + half[i] + quantile * widest) >> 2;
  }
  for (std::int32_t bz = from[2]; bz <= to[2]; ++bz)
    for (std::int32_t by = from[1]; by <= to[1]; ++by)
      for (std::int32_t bx = from[0]; bx <= to[0]; ++bx) {
        const Block* found = block(bx, by, bz);
        if (found == nullptr) continue;
        const double reach = quantile * static_cast<double>(found->widest);
        std::array<std::int32_t, 3> low, high;
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::max(voxel_of(place[i] - half[i] - reach), found->key[i] * kEdge);
          high[i] = std::min(voxel_of(place[i] + half[i] + reach), found->key[i] * kEdge + 3);
        }
        for (std::int32_t z = low[2]; z <= high[2]; ++z)
          for (std::int32_t y = low[1]; y <= high[1]; ++y)
            for (std::int32_t x = low[0]; x <= high[0]; ++x) {
              const auto voxel = static_cast<std::size_t>((z & 3) << 4 | (y & 3) << 2 | (x & 3));
              if ((found->occupied >> voxel & 1) == 0) continue;
              for (std::uint32_t index = found->first[voxel]; index != kNone; index = points_[index].next) visit(index);
            }
      }
}

}  // namespace berm::app

// A height field over a rectangle: one height a cell, a continuous triangulated surface between the cells' centres (constant
// within half a cell of the rim), and ray casting against it with a coarse pyramid of maxima.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "plant/world/vec3.hpp"

namespace berm::plant {

// What a refresh found changed: how many before it did too, and the rectangle in which the surface may be another.
struct HeightChange {
  std::uint64_t number = 0;
  double x_low = 0, y_low = 0, x_high = 0, y_high = 0;
  bool highest = false;  // the highest height with it, on which every ray's begin depends
};

class HeightGrid {
 public:
  // The rectangle's low corner, the cells' sides in metres, their number, and the height all begin with.
  HeightGrid(double x_low, double y_low, double cell_x, double cell_y, int count_x, int count_y, double height);

  [[nodiscard]] int count_x() const { return count_x_; }
  [[nodiscard]] int count_y() const { return count_y_; }
  [[nodiscard]] double cell_x() const { return cell_x_; }
  [[nodiscard]] double cell_y() const { return cell_y_; }
  [[nodiscard]] double cell_area() const { return cell_x_ * cell_y_; }
  [[nodiscard]] double x_low() const { return x_low_; }
  [[nodiscard]] double y_low() const { return y_low_; }
  [[nodiscard]] double centre_x(int ix) const { return x_low_ + (ix + 0.5) * cell_x_; }
  [[nodiscard]] double centre_y(int iy) const { return y_low_ + (iy + 0.5) * cell_y_; }
  // The cell under a point; the nearest one for a point outside.
  [[nodiscard]] int index_x(double x) const;
  [[nodiscard]] int index_y(double y) const;
  [[nodiscard]] bool contains(double x, double y) const;

  [[nodiscard]] double at(int ix, int iy) const { return height_[static_cast<size_t>(iy) * static_cast<size_t>(count_x_) + static_cast<size_t>(ix)]; }
  // Row by row, x fastest.
  [[nodiscard]] const double* data() const { return height_.data(); }
  void set(int ix, int iy, double height);
  // Height of the triangulated surface.
  [[nodiscard]] double surface(double x, double y) const;
  // No cell is higher than this (kept up to date by refresh).
  [[nodiscard]] double highest() const { return highest_; }
  // Higher than everything, by more than rounding.
  [[nodiscard]] bool over(const Vec3& from) const { return from.z > highest_ + rounding; }
  // Recomputes the maxima of the blocks that changed. cast needs it after the last set.
  void refresh();
  [[nodiscard]] const HeightChange& newest_change() const { return change_; }
  // Range at which the ray first meets the surface from above, up to range_max; none otherwise.
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const { return passes_over(ray) ? std::nullopt : cast_low(ray, range_max); }

 private:
  static constexpr double rounding = 1e-9;  // m: more than that of the heights along a ray
  [[nodiscard]] bool passes_over(const Ray& ray) const { return ray.direction.z >= 0 && over(ray.origin); }
  [[nodiscard]] bool leaves_before(const Ray& ray, double t) const;
  [[nodiscard]] std::optional<double> cast_low(const Ray& ray, double range_max) const;
  [[nodiscard]] double clamped(int ix, int iy) const;
  struct Patch { double h00, h10, h01, h11; };  // heights at its corners
  [[nodiscard]] Patch patch(int i, int j) const;
  [[nodiscard]] static std::optional<double> cast_patch(const Patch& patch, int i, int j, const Ray& grid_ray, double t_in, double t_out);
  [[nodiscard]] std::optional<double> cast_block(int bi, int bj, double top, const Ray& grid_ray, const Vec3& inverse, double t_in,
                                                 double t_out) const;

  double x_low_, y_low_, cell_x_, cell_y_;
  int count_x_, count_y_, blocks_x_, blocks_y_;
  std::vector<double> height_;
  std::vector<double> block_max_;     // of every corner of the block's surface patches
  std::vector<unsigned char> stale_;  // blocks whose maximum may be too large
  std::vector<int> stale_list_;
  double highest_;
  HeightChange change_;
};

}  // namespace berm::plant

// Soil in a truck's bed: a surface over the bed, its triangles and its volume.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "truck_world/truck_body.hpp"

namespace berm::truck_world {

enum class Fill { empty, part, heaped, uneven };
constexpr std::array<std::string_view, 4> fill_names{"empty", "part", "heaped", "uneven"};
constexpr std::string_view name_of(Fill fill) { return fill_names[static_cast<std::size_t>(fill)]; }

class BedLoad {
 public:
  // Below the top by rim_clear at every wall, so that the opening's edge is never buried; nowhere steeper than soil lies at an open end.
  BedLoad(const TruckBody& body, Fill fill, Random& random);
  [[nodiscard]] Fill fill() const { return fill_; }
  [[nodiscard]] double volume_m3() const;
  // Height of the soil over the lowest line of the floor; x, y in the truck frame, inside the bed. Below the floor where there is none.
  [[nodiscard]] double height(double x, double y) const;
  // In the truck frame; nothing when empty.
  [[nodiscard]] Mesh mesh() const;

 private:
  [[nodiscard]] double& node(int column, int row) { return height_[static_cast<std::size_t>(row * (columns_ + 1) + column)]; }
  [[nodiscard]] double node(int column, int row) const { return height_[static_cast<std::size_t>(row * (columns_ + 1) + column)]; }

  TruckBody body_;
  Fill fill_;
  int columns_ = 24, rows_ = 12;  // cells along x and y
  std::vector<double> height_;
};

constexpr double rim_clear = 0.08;  // m

}  // namespace berm::truck_world

// The independent oracle: does any part of the machine touch what it must not, and how near is it? It shares no code with the kernel,
// the app or the rest of the plant but the plain description of the machine's shape, and has its own kinematics.
//
// Judged at one moment, every 10 ms step:
//  - implements and upper body against people, vehicles, truck parts and boxes: solid convex bodies, distance by GJK with a
//    certificate (gjk.hpp), within 1e-6 m;
//  - implements against ground outside the dig zones, and inside them against the zone's floor: solid columns. The measure is the
//    vertical gap between a column's top and the lowest point of the part over the column's square. The square is taken by its
//    bounding rectangle in the swing plane's frame, so a column reaches at most 0.21 of a cell's side too far: never too little.
//    A column whose square is not wholly inside a dig zone is outside it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "plant/machine/implement_shape.hpp"
#include "plant/oracle/gjk.hpp"

namespace berm::plant::oracle {

struct Block {                        // a box with a yaw: low and high in the frame at (x, y, z)
  std::string name;
  double x = 0, y = 0, z = 0, yaw = 0;
  std::array<double, 3> low{}, high{};
};

struct Person { std::string name; double x = 0, y = 0, z = 0, radius = 0, height = 0; };

struct Ground {                       // row by row, x fastest; nothing is known outside
  double x_low = 0, y_low = 0, cell = 1;
  int count_x = 0, count_y = 0;
  const double* height = nullptr;
};

struct Zone { double x_low = 0, y_low = 0, x_high = 0, y_high = 0, floor = 0; };

struct Site {
  std::vector<Block> blocks;
  std::vector<Person> people;
  std::vector<Zone> zones;
  Ground ground;
};

// How the base stands: its origin on the ground, turned by yaw, then pitch (front down), then roll (left up).
struct Stand {
  double x = 0, y = 0, yaw = 0, roll = 0, pitch = 0;
};

struct Judgement {
  bool contact = false;
  double closest = 1e9;               // to the nearest person or block; 0 in contact with one
  std::string what;                   // what is touched; else what is closest
  bool by_upper_body = false;         // `what` was touched, or is closest, by the upper body, not by an implement
  double ground_gap = 1e9;            // least vertical gap to forbidden ground; negative when below it
};

class Oracle {
 public:
  explicit Oracle(const ImplementShape& shape) : shape_(shape) {}
  // Joint angles: swing, boom, stick, bucket.
  [[nodiscard]] Judgement judge(const std::array<double, 4>& joints, const Site& site, const Stand& stand = {}) const;
  // The machine's solids in the world: implements first, in the order of the shape's parts, then the upper body.
  [[nodiscard]] std::vector<Body> machine(const std::array<double, 4>& joints, const Stand& stand = {}) const;

 private:
  ImplementShape shape_;
};

// The box as a body.
Body body_of(const Block& block);

}  // namespace berm::plant::oracle

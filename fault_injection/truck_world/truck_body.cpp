#include "truck_world/truck_body.hpp"

#include <algorithm>
#include <cmath>

namespace berm::truck_world {
namespace {

constexpr double mud_cell = 0.4;       // m between points of the walls' faces
constexpr double rim = 0.15;           // m below the top over which mud thins to nothing
constexpr int pipe_segments = 12;      // of the half pipe
constexpr double floor_until = 0.87;   // rad from the lowest line: the pipe counts as floor, beyond as wall

// An upright wall. From start to end its inner face is on the left hand.
struct Wall {
  Vector2d start, end;
  double z_low = 0.0, z_high = 0.0, thickness = 0.0, mud = 0.0;
  Surface surface = Surface::wall_front;
};

void add_wall(Mesh& mesh, const Wall& wall, Random& random) {
  const Vector2d along = (wall.end - wall.start).normalized(), outwards(along.y(), -along.x());
  const double length = (wall.end - wall.start).norm(), height = wall.z_high - wall.z_low;
  const int columns = std::max(2, static_cast<int>(length / mud_cell)), rows = std::max(3, static_cast<int>(height / mud_cell) + 1);
  // The topmost row of cells is the rim.
  const auto z_of = [&](int row) { return row == rows ? wall.z_high : wall.z_low + std::max(height - rim, height * 0.5) * row / (rows - 1); };
  const auto face = [&](double offset, double sense) {
    return [&, offset, sense](int column, int row) {
      const double bump = row == rows ? 0.0 : wall.mud * random.uniform();
      const Vector2d p = wall.start + along * (length * column / columns) + outwards * (offset + sense * bump);
      return Vector3d(p.x(), p.y(), z_of(row));
    };
  };
  add_grid(mesh, columns, rows, face(0.0, -1.0), wall.surface);
  add_grid(mesh, columns, rows, face(wall.thickness, 1.0), wall.surface);
  const Vector2d out = outwards * wall.thickness;
  const auto at = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  const double top = wall.z_high;
  add_quad(mesh, at(wall.start, top), at(wall.end, top), at(wall.end + out, top), at(wall.start + out, top), wall.surface);
  for (const Vector2d& end : {wall.start, wall.end})
    add_quad(mesh, at(end, wall.z_low), at(end + out, wall.z_low), at(end + out, wall.z_high), at(end, wall.z_high), wall.surface);
}

// The lower half of a pipe, inside and outside, below the straight walls.
void add_pipe(Mesh& mesh, const TruckBody& body) {
  const double radius = body.width / 2, x = body.length / 2, centre = body.floor_height + radius;
  const auto at = [&](double px, double r, int i) {
    const double angle = pi * (static_cast<double>(i) / pipe_segments - 0.5);  // from the lowest line, to the left positive
    return Vector3d(px, r * std::sin(angle), centre - r * std::cos(angle));
  };
  for (int i = 0; i < pipe_segments; ++i) {
    const double middle = pi * ((i + 0.5) / pipe_segments - 0.5);
    const Surface wall = middle > 0.0 ? Surface::wall_left : Surface::wall_right;
    const Surface inside = std::abs(middle) < floor_until ? Surface::bed_floor : wall;
    add_quad(mesh, at(-x, radius, i), at(x, radius, i), at(x, radius, i + 1), at(-x, radius, i + 1), inside);
    const double outer = radius + body.wall_thickness;
    add_quad(mesh, at(-x, outer, i), at(x, outer, i), at(x, outer, i + 1), at(-x, outer, i + 1), wall);
    add_quad(mesh, at(-x, radius, i), at(-x, outer, i), at(-x, outer, i + 1), at(-x, radius, i + 1), wall);  // rear rim
  }
}

void add_bed(Mesh& mesh, const TruckBody& body, Random& mud) {
  const double x = body.length / 2, y = body.width / 2, t = body.wall_thickness, floor = body.floor_height;
  const double wall_foot = body.bed == BedShape::box ? floor : floor + y;
  Random& r = mud;
  add_wall(mesh, {{-x, -y}, {x, -y}, wall_foot, body.top(), t, body.mud, Surface::wall_right}, r);
  add_wall(mesh, {{x, y}, {-x, y}, wall_foot, body.top(), t, body.mud, Surface::wall_left}, r);
  // The front wall, and the tailgate, reach over the side walls' ends.
  const auto end_wall = [&](const Vector2d& start, const Vector2d& end, Surface surface) {
    add_wall(mesh, {start, end, floor, body.top(), t, body.mud, surface}, r);
  };
  end_wall({x, -y - t}, {x, y + t}, Surface::wall_front);
  if (body.tailgate == Tailgate::up) end_wall({-x, y + t}, {-x, -y - t}, Surface::wall_rear);
  if (body.tailgate == Tailgate::down) {
    const double low = std::max(0.15, floor - body.wall_height);
    add_box(mesh, {-x - 0.02 - t, -y - t, low}, {-x - 0.02, y + t, floor - 0.02}, Surface::truck_body);
  }
  if (body.bed == BedShape::box) {
    add_box(mesh, {-x, -y, floor - t}, {x, y, floor}, Surface::bed_floor);
  } else {
    add_pipe(mesh, body);
  }
}

void add_undercarriage(Mesh& mesh, const TruckBody& body) {
  const double x = body.length / 2, y = body.outer_width() / 2, under = body.floor_height - body.wall_thickness - 0.02;
  const double cab_rear = body.length / 2 + body.wall_thickness + body.cab_gap;
  add_box(mesh, {-x + 0.2, -0.45, 0.55}, {body.front() - 0.1, 0.45, under}, Surface::truck_body);
  if (body.tracks) {
    for (const double side : {-1.0, 1.0}) {
      const double a = side * (y - 0.5), b = side * y;
      add_box(mesh, {-x + 0.1, std::min(a, b), 0.0}, {cab_rear + 0.3, std::max(a, b), std::min(0.85, under)}, Surface::truck_body);
    }
    return;
  }
  for (const double wheel_x : {-x + 0.7, -x + 2.0, cab_rear + 0.5 * body.cab_length})
    for (const double side : {-1.0, 1.0}) add_wheel(mesh, {wheel_x, side * (y - 0.25), 0.5}, 0.5, 0.4, Surface::truck_body);
}

void add_cab(Mesh& mesh, const TruckBody& body) {
  const double front_wall = body.length / 2 + body.wall_thickness, y = body.outer_width() / 2;
  add_box(mesh, {front_wall + body.cab_gap, -std::min(y, 1.25), 0.8}, {body.front(), std::min(y, 1.25), body.cab_top}, Surface::truck_body);
  if (!body.canopy) return;
  // A sheet that begins behind the top of the front wall, so that the wall's own top stays what bounds the opening.
  const double rear = front_wall, front = front_wall + body.canopy_length, thickness = 0.05;
  const Vector3d rise(0, 0, body.canopy_rise), down(0, 0, -thickness);
  const Vector3d a(rear, -y, body.top()), b(rear, y, body.top());
  const Vector3d c = Vector3d(front, y, body.top()) + rise, d = Vector3d(front, -y, body.top()) + rise;
  add_quad(mesh, a, b, c, d, Surface::truck_body);
  add_quad(mesh, a + down, b + down, c + down, d + down, Surface::truck_body);
  add_quad(mesh, d, c, c + down, d + down, Surface::truck_body);
  add_quad(mesh, a, d, d + down, a + down, Surface::truck_body);
  add_quad(mesh, b, c, c + down, b + down, Surface::truck_body);
}

double in(Random& random, const Range& range) { return random.uniform(range[0], range[1]); }

}  // namespace

double TruckBody::floor_rise(double y) const {
  if (bed == BedShape::box) return 0.0;
  const double radius = width / 2;
  return radius - std::sqrt(std::max(0.0, radius * radius - y * y));
}

double TruckBody::struck_volume() const {
  const double pipe = bed == BedShape::half_round ? (2.0 - pi / 2.0) * width * width / 4.0 : 0.0;
  return length * (width * wall_height - pipe);
}

TruckBody draw_truck_body(const TruckClass& c, Random& random) {
  const auto inside = [](double value, const Range& range) { return value >= range[0] && value <= range[1]; };
  for (int attempt = 0; attempt < 10000; ++attempt) {
    TruckBody b;
    b.bed = c.bed;
    b.tracks = c.tracks;
    b.length = in(random, c.inside_length);
    b.width = in(random, c.inside_width);
    b.wall_height = in(random, c.wall_height);
    b.wall_thickness = in(random, c.wall_thickness);
    b.floor_height = in(random, c.floor_height);
    const double gate = random.uniform();
    b.tailgate = gate < c.tailgate.up ? Tailgate::up : gate < c.tailgate.up + c.tailgate.down ? Tailgate::down : Tailgate::none;
    b.canopy = c.canopy;
    b.canopy_length = in(random, c.canopy_length);
    b.canopy_rise = in(random, c.canopy_rise);
    b.cab_gap = in(random, c.cab_gap);
    b.cab_length = in(random, c.cab_length);
    b.cab_top = in(random, c.cab_top);
    b.mud = in(random, c.mud);
    if (b.canopy) b.cab_top = std::min(b.cab_top, b.top() - 0.1);
    if (inside(b.struck_volume(), c.volume_m3) && inside(b.top(), c.wall_top)) return b;
  }
  throw std::runtime_error("truck class '" + c.name + "': volume_m3 and wall_top leave almost no truck of its sizes");
}

std::array<Vector3d, 4> opening_corners(const TruckBody& body) {
  const double x = body.length / 2, y = body.width / 2, z = body.top();
  return {Vector3d(x, y, z), Vector3d(-x, y, z), Vector3d(-x, -y, z), Vector3d(x, -y, z)};
}

Mesh truck_mesh(const TruckBody& body, Random& mud) {
  Mesh mesh;
  add_bed(mesh, body, mud);
  add_undercarriage(mesh, body);
  add_cab(mesh, body);
  return mesh;
}

}  // namespace berm::truck_world

// Everything a scanner can see at one moment, gathered once a step, and the first thing a ray meets.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "plant/machine/implement_shape.hpp"
#include "plant/world/bed_heap.hpp"
#include "plant/world/link_frames.hpp"
#include "plant/world/movers.hpp"
#include "plant/world/solids.hpp"
#include "plant/world/terrain.hpp"
#include "plant/world/truck.hpp"

namespace berm::plant {

constexpr int no_mover = -1;

// What a ray meets first: where, and which person or vehicle it is (its place among the movers), if it is one.
struct SceneHit { double range; int mover; };

// Rays out of one place that stay near an upright plane through it, as the lasers of one firing do: forward along `ahead`, and their directions at most
// `spread` to either side, along `aside`.
struct RayFan {
  Vec3 origin, ahead, aside;
  double spread = 0;
};

// What rays of a fan may meet; all else in the scene they need not be held against.
struct FanView {
  static constexpr std::size_t most = 64;  // of each kind; a scene of more is looked at whole
  struct Few {
    std::array<std::uint8_t, most> index{};
    std::size_t count = 0;
    void add(std::size_t i) { index[count++] = static_cast<std::uint8_t>(i); }
    [[nodiscard]] const std::uint8_t* begin() const { return index.data(); }
    [[nodiscard]] const std::uint8_t* end() const { return index.data() + count; }
  };
  bool implement = true;
  Few upper_body, track, truck, box, person;
  // Nothing but the ground.
  [[nodiscard]] bool bare() const { return !implement && upper_body.count + track.count + truck.count + box.count + person.count == 0; }
};

// Where a scene differs from another of the same machine and site, by boxes that hold what is otherwise in either.
struct SceneDifference {
  bool everywhere = false;
  std::vector<BoxSolid> site, machine;  // in the world, in the upper body's frame
  [[nodiscard]] bool none() const { return !everywhere && site.empty() && machine.empty(); }
  // Whether rays of the fan may meet it.
  [[nodiscard]] bool may_be_met(const RayFan& world, const RayFan& upper) const;
};

class Scene {
 public:
  // Walls and cab of trucks, people, vehicles, fixed boxes.
  void place_site(const Terrain& terrain, const std::vector<Truck>& trucks, const Movers& movers, const std::vector<BoxConfig>& boxes);
  // The machine at one pose of boom, stick and bucket, with its load heaped over the mouth. Upper body's frame: the swing stays out of it.
  void place_machine(const ImplementShape& shape, const LinkFrames& links, double heap_volume);

  // The first hit. The rays are the same one: in the world, in the base frame and in the upper body's.
  [[nodiscard]] std::optional<SceneHit> meet(const Ray& world, const Ray& base, const Ray& upper, double range_max) const;
  // The same of a ray of the fan that the view is of.
  [[nodiscard]] std::optional<SceneHit> meet(const FanView& view, const Ray& world, const Ray& base, const Ray& upper, double range_max) const;
  // Whether no ray that does not fall meets the ground from there.
  [[nodiscard]] bool over_ground(const Vec3& from) const { return terrain_ == nullptr || terrain_->grid().over(from); }
  // The fan in the same three frames. False, and no view, where the scene has more than a view can tell of.
  [[nodiscard]] bool look(const RayFan& world, const RayFan& base, const RayFan& upper, FanView& view) const;
  [[nodiscard]] SceneDifference difference(const Scene& before) const;
  // Its range.
  [[nodiscard]] std::optional<double> cast(const Ray& world, const Ray& base, const Ray& upper, double range_max) const;

 private:
  // A truck's boxes and heap behind one bounding box.
  struct TruckSolid {
    PlanarFrame frame;
    Vec3 low, high;
    std::vector<BoxSolid> part;
    const BedHeap* heap = nullptr;
    std::uint64_t heap_changes = 0;
    bool operator==(const TruckSolid&) const = default;
  };
  template <class Indices>
  [[nodiscard]] std::optional<SceneHit> first(const Indices& of, const Ray& world, const Ray& base, const Ray& upper, double range_max) const;
  [[nodiscard]] double cast_truck(const TruckSolid& truck, const Ray& world, double range) const;
  [[nodiscard]] double cast_beyond(const Ray& world, double range) const;
  [[nodiscard]] double cast_step_at_rim(const Ray& world, double range) const;

  const Terrain* terrain_ = nullptr;
  std::uint64_t ground_changes_ = 0;  // of the terrain, and below of a truck's load: how many there had been
  std::vector<TruckSolid> truck_;
  std::vector<BoxSolid> box_;
  std::vector<CylinderSolid> person_;
  std::vector<int> box_mover_, person_mover_;  // beside them: which mover it is, no_mover for a fixed box
  std::vector<PrismSolid> implement_;
  std::vector<BoxSolid> upper_body_, track_;
  Vec3 implement_low_, implement_high_;
};

// Keeps a hit that came back from a person or vehicle; returns may be null.
void note(const SceneHit& hit, const Ray& world, std::vector<MoverReturn>* returns);

}  // namespace berm::plant

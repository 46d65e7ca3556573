// A truck with its rear to a panning scanner, a cloud of dust about it or before it, and what the scanner makes of them, beside the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/scanner.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/truck.hpp"

namespace berm::echoes {

enum class Place { about, before };  // of the cloud: round the truck, or between scanner and truck with clear air behind it

struct StageOptions {
  double rear_m = 6.0;        // from the scanner to the truck's rear
  double ahead_m = 2.5;       // of the rear, where the cloud about the truck begins
  double reflectivity = 0.3, range_stddev = 0.0, window_percent = 98.0;
  std::uint64_t seed = 1;
};

struct Box { double x_low, x_high, z_low, z_high; };  // in the upright plane through scanner and truck

struct EchoSample {
  bool truck = false;         // the beam meets the truck first,
  bool rear = false;          // and there its rear wall or what is under it
  double truth = 0.0;         // m; 0: it meets nothing within range
  double cloud_from = 0.0;    // m, where it enters the cloud; 0: it does not
  double range = 0.0;         // m, as the packet has it; 0: no return
  int echoes = 0;
  double elevation = 0.0;     // rad
};

class Stage {
 public:
  explicit Stage(const StageOptions& options);
  // Scanlines side by side over the truck's rear, or one along its middle. extinction: 1/m; 0: no cloud.
  [[nodiscard]] std::vector<EchoSample> scan(plant::Ranging ranging, Place place, double extinction, int scanlines) const;
  // A single return off the rear wall at scanner height's own elevation, as the panel of the picture shows it.
  [[nodiscard]] plant::PulsePath path(Place place, double extinction) const;

  [[nodiscard]] std::vector<Box> truck_boxes() const;
  [[nodiscard]] Box cloud_box(Place place) const;
  [[nodiscard]] const plant::ScannerConfig& scanner() const { return scanner_; }
  [[nodiscard]] double head_z() const;

 private:
  [[nodiscard]] plant::SensorAir air(Place place, double extinction) const;

  StageOptions options_;
  plant::ScannerConfig scanner_;
  plant::Terrain terrain_;
  std::vector<plant::Truck> truck_;
  plant::Movers nobody_{{}};
  plant::Scene with_truck_, without_;
};

}  // namespace berm::echoes

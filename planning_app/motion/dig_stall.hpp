// Whether a bucket in the soil is stalled: its joints do not get on though they are told to, and the cylinders press as hard as they can.
#pragma once

#include <optional>

namespace berm::app {

// What is seen of a dig in one cycle.
struct DigEffort {
  bool held = false;               // the joints do not come after the path's reference
  double let_out = 1.0;            // share of the request that the kernel lets out of the joint that it slows most
  std::optional<double> force_n = std::nullopt;  // of the soil on the bucket, by the cylinders' pressures, in whatever direction; nothing while the implements' weight is not known
  double tip_speed = 0.0;          // m/s
};

// How hard the machine can press no file says: it is the hardest force that it was seen to overcome, in this dig and those before.
class DigStall {
public:
  // load_scale: what the bucket holds beside the machine on which the usual force was tried.
  explicit DigStall(double load_scale) : hardest_n_(usual_n * load_scale) {}

  void begin() { held_s_ = pressed_s_ = 0.0; force_n_ = 0.0; }
  void add(const DigEffort& effort, double dt);
  enum class Told { no, by_soil, standing };  // standing: the joints do not get on, and nothing presses on the bucket
  Told told() const;
  double hardest_n() const { return hardest_n_; }

private:
  static constexpr double usual_n = 25e3;

  double hardest_n_;
  double force_n_ = 0.0;           // over the last tenth of a second
  double held_s_ = 0.0;            // the shorter the less the kernel lets out
  double pressed_s_ = 0.0;         // ... of these with a force that is as hard as the machine can, or unknown
};

}  // namespace berm::app

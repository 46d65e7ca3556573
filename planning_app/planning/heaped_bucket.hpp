// What a heaped bucket of this soil weighs: the machine file's figure is for common soil, and a lighter one fills the bucket with less.
#pragma once

#include <vector>

namespace berm::app {

class HeapedBucket {
public:
  // most_kg: of the heaviest soil.
  explicit HeapedBucket(double most_kg) : most_kg_(most_kg), kg_(most_kg) {}

  double kg() const { return kg_; }

  // What it was weighed with: it holds that at least.
  void held(double weighed_kg);
  // Of a dig that the force ended at its goal: the goal, what the bucket held when it had been lifted, and the force's impulse, N s. Where three in a row
  // come up short and alike, though one took more force than another, the bucket was full.
  void learn(double goal_kg, double weighed_kg, double impulse);

private:
  struct Dig { double kg = 0.0, impulse = 0.0; };

  double most_kg_, kg_;
  std::vector<Dig> short_;  // in a row
};

}  // namespace berm::app

#ifndef OBSCURA_SCENE_SCENES_RANDOM_H_
#define OBSCURA_SCENE_SCENES_RANDOM_H_

#include <cstdint>

namespace obscura::tools {

// Numbers from a seed, the same everywhere (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x632BE59BD9B4E019u) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  double unit() { return double(bits() >> 11) * 0x1p-53; }  // [0, 1)
  double in(double low, double high) { return low + (high - low) * unit(); }
  int below(int count) { return int(unit() * count); }

 private:
  std::uint64_t state_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_SCENES_RANDOM_H_

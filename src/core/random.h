#ifndef OBSCURA_SRC_CORE_RANDOM_H_
#define OBSCURA_SRC_CORE_RANDOM_H_

#include <cstdint>
#include <vector>

namespace obscura {

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers from the same seed on every machine, which
// the standard library's distributions do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // [0, 1)
  int below(int n) { return static_cast<int>(uniform() * n); }              // [0, n)

 private:
  std::uint64_t state_;
};

// 0 ... count - 1 in random order.
inline std::vector<int> shuffled(int count, Random* random) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) {
    const int j = random->below(i + 1);
    order[i] = order[j];
    order[j] = i;
  }
  return order;
}

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_RANDOM_H_

#ifndef OBSCURA_SRC_GPU_QUADS_H_
#define OBSCURA_SRC_GPU_QUADS_H_

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace obscura::gpu {

inline std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }
inline std::uint32_t bits(int value) { return static_cast<std::uint32_t>(value); }

// Tables whose entries are four words, numbers of either kind.
class Quads {
 public:
  int size() const { return static_cast<int>(words_.size() / 4); }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    for (std::uint32_t word : {a, b, c, d}) words_.push_back(std::bit_cast<float>(word));
  }
  void set(int quad, int word, int value) {
    words_[4 * quad + word] = std::bit_cast<float>(bits(value));
  }
  int get(int quad, int word) const { return std::bit_cast<int>(words_[4 * quad + word]); }
  int add_floats(std::span<const float> values) {
    const int start = size();
    words_.insert(words_.end(), values.begin(), values.end());
    words_.resize((words_.size() + 3) / 4 * 4, 0.0f);
    return start;
  }
  const std::vector<float>& words() const { return words_; }

 private:
  std::vector<float> words_;
};

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_QUADS_H_

#ifndef OBSCURA_TESTS_FUZZ_BYTES_H_
#define OBSCURA_TESTS_FUZZ_BYTES_H_

#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace obscura::fuzz {

// A fuzzer's bytes as choices; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  int below(int count) { return next() % count; }
  bool flag() { return next() & 1; }

  // Numbers that go wrong, ordinary ones, and any bits at all.
  float number() {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr float kSpecial[] = {
        0.0f,   -0.0f, 1.0f,   -1.0f,   kInf,     -kInf, std::numeric_limits<float>::quiet_NaN(),
        1e-30f, 1e30f, 1e-45f, 3.4e38f, 65504.0f, 1e9f};
    const int kind = next();
    if (kind < 32) return kSpecial[kind % std::size(kSpecial)];
    if (kind < 48) {
      std::uint8_t bits[4] = {next(), next(), next(), next()};
      float value;
      std::memcpy(&value, bits, sizeof(value));
      return value;
    }
    return 0.5f + static_cast<float>(kind) / 64 + static_cast<float>(next()) / 4096;
  }

  // A depth: nearly always one that a call takes.
  float depth() {
    constexpr float kOdd[] = {std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN(),
                              1e30f,
                              3.4e38f,
                              1e9f,
                              65504.0f,
                              1e-30f,
                              1e8f};
    const int kind = next();
    if (kind == 1) return number();
    if (kind < 32) return kOdd[kind % std::size(kOdd)];
    return static_cast<float>(kind) / 64 + static_cast<float>(next()) / 4096;
  }

 private:
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace obscura::fuzz

#endif  // OBSCURA_TESTS_FUZZ_BYTES_H_

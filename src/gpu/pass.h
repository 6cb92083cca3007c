#ifndef OBSCURA_SRC_GPU_PASS_H_
#define OBSCURA_SRC_GPU_PASS_H_

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "gpu/shader.h"
#include "obscura/status.h"
#include "obscura/views.h"

namespace obscura::gpu {

// What a pass reads or writes: a region of the scratch memory by its number, or an image of the
// frame.
struct Slot {
  enum Kind {
    kRegion,
    kDepthImage,
    kBackDepthImage,
    kNormalImage,
    kVisibilityImage,
    kBentNormalImage,
    // Of the light, which reads what an estimator has written.
    kVisibilityInput,
    kBentNormalInput,
    kAlbedoImage,
    kLightImage
  };
  Kind kind = kRegion;
  int region = 0;

  Slot(int number) : region(number) {}
  Slot(Kind image) : kind(image) {}
  bool is_result() const {
    return kind == kVisibilityImage || kind == kBentNormalImage || kind == kLightImage;
  }
  bool operator==(const Slot&) const = default;
};

struct BoundSlot {
  Binding at;
  Slot slot;

  bool operator==(const BoundSlot&) const = default;
};

struct ConstantValue {
  std::uint32_t id, value;

  template <class T>
  ConstantValue(Constant<T> constant, std::type_identity_t<T> v)
      : id(constant.id), value(static_cast<std::uint32_t>(v)) {}
  bool operator==(const ConstantValue&) const = default;
};

// A shader's own push constants, after FrameConstants; Vulkan promises room for 128 bytes in all.
inline constexpr std::size_t kMaxPush = 16;

// The words of an x_io::Push.
template <class Push>
std::vector<std::uint32_t> push_words(const Push& push) {
  static_assert(sizeof(Push) <= kMaxPush * sizeof(std::uint32_t));
  std::vector<std::uint32_t> words(sizeof(Push) / sizeof(std::uint32_t));
  std::memcpy(words.data(), &push, sizeof(Push));
  return words;
}

// One run of a shader. Constants, slots and push constants are named as its interface header names
// them, each of them once, in any order.
struct Pass {
  const char* name;  // passes of equal name are one in reports
  Shader shader;
  std::vector<ConstantValue> constants{};
  std::vector<BoundSlot> slots{};
  Extent size{1, 1};                // groups do a tile of it each (Interface::tile)
  int layers = 1;                   // groups in z
  float radius = 0, thickness = 0;  // in FrameConstants
  std::vector<std::uint32_t> push{};
  bool overlaps = false;    // depends on nothing that the pass before writes: no barrier between
  std::uint64_t bytes = 0;  // that it touches, if not all of what its slots name
  bool half = false;        // FrameConstants are those at half resolution; set by Program::add

  // Whether results go to scratch memory, which is the shader's second form.
  bool to_scratch() const;
  std::span<const std::uint32_t> words() const {
    return to_scratch() ? shader.to_scratch : shader.words;
  }
};

// Whether a pass gives its shader all that the interface has, and nothing else.
Status check(const Pass& pass);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_PASS_H_

#ifndef OBSCURA_SRC_GPU_INTERFACE_H_
#define OBSCURA_SRC_GPU_INTERFACE_H_

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "obscura/views.h"

namespace obscura::gpu {

// A specialization constant of a shader, of type T.
template <class T>
struct Constant {
  std::uint32_t id;
};

enum class BindingKind {
  kNone,
  kBuffer,
  kImage,    // that is read
  kResult,   // an image that is written or, in the shader's second form, a buffer
  kWritten,  // an image that is written, in the shader's only form
};

struct Binding {
  std::uint32_t binding = 0;
  BindingKind kind = BindingKind::kNone;

  bool operator==(const Binding&) const = default;
};

// All that a shader and those who run it must agree on; each x_io.h makes one (gpu/io.h).
struct Interface {
  static constexpr int kMaxConstants = 32, kMaxBindings = 16;

  const char* name;
  Extent threads;               // of a group
  Extent tile;                  // what of a pass's size one group does
  std::size_t push_bytes;       // after FrameConstants
  std::uint32_t constants = 0;  // bit i: there is a constant of id i
  std::array<BindingKind, kMaxBindings> bindings{};
};

// `has_constant` and `kind_of` say for each std::integral_constant whether and what there is.
template <class HasConstant, class KindOf>
constexpr Interface make_interface(const char* name, Extent threads, Extent tile,
                                   std::size_t push_bytes, HasConstant has_constant,
                                   KindOf kind_of) {
  Interface io{name, threads, tile.width > 0 ? tile : threads, push_bytes};
  [&]<int... i>(std::integer_sequence<int, i...>) {
    ((io.constants |= has_constant(std::integral_constant<int, i>()) ? 1u << i : 0u), ...);
  }
  (std::make_integer_sequence<int, Interface::kMaxConstants>());
  [&]<int... i>(std::integer_sequence<int, i...>) {
    ((io.bindings[i] = kind_of(std::integral_constant<int, i>())), ...);
  }
  (std::make_integer_sequence<int, Interface::kMaxBindings>());
  return io;
}

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_INTERFACE_H_

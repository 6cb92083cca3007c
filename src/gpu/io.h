#ifndef OBSCURA_SRC_GPU_IO_H_
#define OBSCURA_SRC_GPU_IO_H_

// The words of interface headers (x_io.h beside x.comp), which shader and host both read. GLSL
// makes layouts of them; C++ makes names in the namespace x_io, and kInterface, a table of them
// all. tests/unit/gpu/interface_test.cpp compares that table with the compiled shader.
//
//   IO_BEGIN(x_io)                        first
//   IO_NUMBER(kTile, 16);                 an int that both sides use
//   IO_THREADS(16, 8);                    invocations of a group; kThreads is their number
//   IO_TILE(kTile, kTile);                what of a pass's size a group does, if not as many
//   IO_CONSTANT(0, int, kSamples, 9);     specialization constant 0 and its default
//   IO_READS(0, Depth, float, depth);     buffer 0 of floats: kDepthAt in C++, depth[] in GLSL
//   IO_WRITES(1, Sums, vec4, sums);       the same, written only
//   IO_UPDATES(2, Totals, float, totals); the same, read and written
//   IO_IMAGE(3, DepthImage, depth_image); a texture2D
//   IO_VISIBILITY(4);                     kVisibilityResultAt; gpu/results.glsl writes it
//   IO_DIRECTIONS(5);                     kDirectionResultAt; gpu/direction_result.glsl writes it
//   IO_LIGHT(6);                          kLightResultAt; an image that is written
//   IO_PUSH(int start; float edge;);      push constants after FrameConstants: Push in C++, members
//                                         of `view` in GLSL; IO_NO_PUSH where there are none
//   IO_END                                last
#include "gpu/frame_constants.h"

#ifdef __cplusplus

#include "gpu/interface.h"

// A number or binding that is given twice is a second specialization, which C++ refuses.
#define IO_BEGIN(name)                        \
  namespace obscura::gpu::name {              \
  inline constexpr const char* kName = #name; \
  template <int>                              \
  inline constexpr bool kHasConstant = false; \
  template <int>                              \
  inline constexpr BindingKind kKind = {};    \
  template <int>                              \
  inline constexpr Extent kTileOf = {};
#define IO_NUMBER(name, value) inline constexpr int name = value
#define IO_THREADS(x, y)                       \
  inline constexpr Extent kGroup = {(x), (y)}; \
  inline constexpr int kThreads = (x) * (y)
#define IO_TILE(x, y) \
  template <>         \
  inline constexpr Extent kTileOf<0> = {(x), (y)}
#define IO_CONSTANT(id, type, name, value)       \
  template <>                                    \
  inline constexpr bool kHasConstant<id> = true; \
  inline constexpr Constant<type> name { id }
#define IO_BINDING(at, name, kind)               \
  template <>                                    \
  inline constexpr BindingKind kKind<at> = kind; \
  inline constexpr Binding k##name##At { at, kind }
#define IO_READS(at, name, type, array) IO_BINDING(at, name, BindingKind::kBuffer)
#define IO_WRITES(at, name, type, array) IO_BINDING(at, name, BindingKind::kBuffer)
#define IO_UPDATES(at, name, type, array) IO_BINDING(at, name, BindingKind::kBuffer)
#define IO_IMAGE(at, name, image) IO_BINDING(at, name, BindingKind::kImage)
#define IO_VISIBILITY(at) IO_BINDING(at, VisibilityResult, BindingKind::kResult)
#define IO_DIRECTIONS(at) IO_BINDING(at, DirectionResult, BindingKind::kResult)
#define IO_LIGHT(at) IO_BINDING(at, LightResult, BindingKind::kWritten)
#define IO_PUSH(words) \
  struct Push {        \
    words              \
  };                   \
  inline constexpr std::size_t kPushBytes = sizeof(Push)
#define IO_NO_PUSH inline constexpr std::size_t kPushBytes = 0
#define IO_END                                                                       \
  inline constexpr Interface kInterface = make_interface(                            \
      kName, kGroup, kTileOf<0>, kPushBytes, [](auto i) { return kHasConstant<i>; }, \
      [](auto i) { return kKind<i>; });                                              \
  }

#else

#define IO_BEGIN(name)
#define IO_NUMBER(name, value) const int name = value
#define IO_THREADS(x, y)                             \
  layout(local_size_x = (x), local_size_y = (y)) in; \
  const int kThreads = (x) * (y)
#define IO_TILE(x, y) const ivec2 kGroupTile = ivec2(x, y)
#define IO_CONSTANT(id, type, name, value) layout(constant_id = id) const type name = value
#define IO_READS(at, name, type, array) \
  layout(binding = at) readonly buffer name { type array[]; }
#define IO_WRITES(at, name, type, array) \
  layout(binding = at) writeonly buffer name { type array[]; }
#define IO_UPDATES(at, name, type, array) \
  layout(binding = at) buffer name { type array[]; }
#define IO_IMAGE(at, name, image) layout(binding = at) uniform texture2D image
#ifdef TO_SCRATCH
#define IO_VISIBILITY(at) IO_WRITES(at, VisibilityResult, float, visibility_result)
#define IO_DIRECTIONS(at) IO_WRITES(at, DirectionResult, vec4, direction_result)
#else
#define IO_VISIBILITY(at) layout(binding = at) uniform writeonly image2D visibility_result
#define IO_DIRECTIONS(at) layout(binding = at) uniform writeonly image2D direction_result
#endif
#define IO_LIGHT(at) layout(binding = at) uniform writeonly image2D light_result
#define IO_PUSH(words) layout(push_constant) uniform View{OBSCURA_FRAME_CONSTANTS words} view
#define IO_NO_PUSH layout(push_constant) uniform View{OBSCURA_FRAME_CONSTANTS} view
#define IO_END

#endif

#endif  // OBSCURA_SRC_GPU_IO_H_

// From voxels to the skewed vectors of a strip and back; included once per SIMD target.
#if defined(OBSCURA_SRC_VOLUME_STRIP_STORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_VOLUME_STRIP_STORE_INL_H_
#undef OBSCURA_SRC_VOLUME_STRIP_STORE_INL_H_
#else
#define OBSCURA_SRC_VOLUME_STRIP_STORE_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/cache_control.h"
#include "hwy/highway.h"
#include "volume/strip_walk-inl.h"
#include "volume/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
constexpr int kBlock = 16;  // bytes transposed at a time

// Opacities of a plane as skewed vectors; rows beside the plane's are open.
void SkewPlane(const Layout& layout, const std::uint8_t* tau, int width, int height, bool mirrored,
               std::uint8_t* rows, std::ptrdiff_t pitch, std::int16_t* opacity) {
  const RowsTag d;
  const hn::Rebind<std::uint8_t, RowsTag> d8;
  const hn::RebindToUnsigned<RowsTag> du;
  HWY_ALIGN std::uint8_t columns[kBlock * kRows];
  for (int s = 0; s < layout.strips; ++s) {
    for (int j = 0; j < kRows; ++j) {
      std::uint8_t* row = rows + j * pitch + kBlock;
      const int y = s * kRows + j;
      if (y >= height) {
        std::memset(row, 255, static_cast<std::size_t>(width));
      } else if (mirrored) {
        const std::uint8_t* from = tau + static_cast<std::ptrdiff_t>(y) * width;
        std::reverse_copy(from, from + width, row);
      } else {
        std::memcpy(row, tau + static_cast<std::ptrdiff_t>(y) * width,
                    static_cast<std::size_t>(width));
      }
    }
    std::int16_t* to = opacity + s * layout.strip_size() * kSides;
    for (int t = 0; t < layout.steps; t += kBlock) {
      SkewBytes<kRows>(rows + kBlock + t, pitch - 1, columns);
      for (int i = 0; i < kBlock; ++i, to += kLanes) {
        const auto bytes = hn::Load(d8, columns + i * kRows);
        const auto v = hn::Sub(hn::Set(du, 255), hn::PromoteTo(du, bytes));
        // 255 becomes 32767, 0 stays.
        const auto wide = hn::Add(hn::ShiftLeft<7>(v), hn::ShiftRight<1>(v));
        hn::Store(hn::BitCast(d, wide), d, to);
      }
    }
  }
}

// Visibilities of one strip: skewed, as they are swept, and the voxels that they are written to.
struct Strip {
  const std::uint8_t* const* channels;  // skewed
  int steps, rows, width;
  std::uint8_t* voxels;  // the channels' first in the first voxel of the strip
  std::ptrdiff_t voxel;  // bytes from voxel to voxel
  // The next strip, to prefetch it: the hardware prefetcher does not follow sixteen rows at a time.
  const std::uint8_t* next;
};
constexpr int kCacheLine = 64;

// Writes the kUsed bytes of a transposed voxel. If kLoose, the bytes after it may be overwritten,
// since they are written later.
template <int kUsed, bool kLoose>
HWY_INLINE void CopyVoxel(const std::uint8_t* from, std::ptrdiff_t next, std::uint8_t* to) {
  constexpr int kFirst = kUsed <= 8 ? (kLoose ? 8 : 4) : std::min(16, kLoose ? 16 : kUsed);
  std::memcpy(to, from, kFirst);
  if constexpr (kUsed > 16) {
    std::memcpy(to + 16, from + next, kUsed - 16);
  } else if constexpr (kUsed > kFirst) {
    std::memcpy(to + kFirst, from + kFirst, kUsed - kFirst);
  }
}

// Transposes rows of channels into voxels of kUsed channels.
template <int kUsed, bool kMirrored>
void StoreStrip(const Strip& strip) {
  constexpr int kRoom = kUsed <= 8 ? 8 : kUsed <= 16 ? 16 : 32;  // bytes of a transposed voxel
  constexpr int kPerBlock = kRoom < 16 ? 16 / kRoom : 1, kBlocks = kRoom < 16 ? 1 : kRoom / 16;
  const hn::ScalableTag<std::uint8_t> d;
  using VB = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d)), together = lanes / kRows;
  HWY_ALIGN std::uint8_t turned[HWY_MAX_BYTES * kRoom];
  // Local copies: the compiler must assume that writing bytes changes the members.
  const int steps = strip.steps, rows = strip.rows, width = strip.width;
  const std::ptrdiff_t voxel = strip.voxel, across = (kMirrored ? width + 1 : width - 1) * voxel;
  std::uint8_t* const voxels = strip.voxels;
  const std::uint8_t* channels[kUsed];
  std::copy_n(strip.channels, kUsed, channels);
  const std::ptrdiff_t ahead = kMirrored ? 0 : rows * width * voxel * together / steps + kCacheLine;
  const std::uint8_t* next = strip.next;
  for (int t = 0; t < steps; t += together) {
    for (std::ptrdiff_t i = 0; i < ahead; i += kCacheLine) hwy::Prefetch(next + i);
    next += ahead;
    VB v[kRoom];
    for (int c = 0; c < kRoom; ++c) {
      v[c] = c < kUsed ? hn::LoadU(d, channels[c] + t * kRows) : hn::Zero(d);
    }
    PerfectShuffle<kRoom, Log2(kRoom)>(d, v);
    for (int c = 0; c < kRoom; ++c) hn::Store(v[c], d, turned + c * lanes);
    // Shuffles stay within blocks of 16 bytes: the voxels of a block are now in the same block of
    // consecutive vectors.
    for (int i = 0; i < together; ++i) {
      const int x = t + i;  // of lane 0; each lane is one behind the one before it
      const std::uint8_t* from = turned + i * kRows / 16 * 16 + i * kRows % 16 * kRoom / 16 * lanes;
      const std::ptrdiff_t column = kMirrored ? width - 1 - x : x;
      if (rows == kRows && x >= kRows - 1 && x < width - 1) {
        std::uint8_t* to = voxels + column * voxel;
        for (int j = 0; j < kRows; j += kPerBlock) {
          for (int b = 0; b < kPerBlock; ++b, to += across) {
            CopyVoxel<kUsed, !kMirrored>(from + b * kRoom, lanes, to);
          }
          from += kBlocks * lanes;
        }
        continue;
      }
      const int first = std::max(0, x - width + 1), last = std::min(rows - 1, x);
      for (int j = first; j <= last; ++j) {
        CopyVoxel<kUsed, false>(from + j / kPerBlock * kBlocks * lanes + j % kPerBlock * kRoom,
                                lanes, voxels + column * voxel + j * across);
      }
    }
  }
}

// Four rows of bytes, one per channel, become voxels of four bytes.
void InterleaveRow(const std::uint8_t* const channels[4], const bool mirrored[4], int width,
                   std::uint8_t* out) {
  constexpr int kChannels = 4;
  const hn::Full128<std::uint8_t> d;
  HWY_ALIGN static constexpr std::uint8_t kBackward[16] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                           7,  6,  5,  4,  3,  2,  1, 0};
  const auto backward = hn::Load(d, kBackward);
  HWY_ALIGN std::uint8_t block[kBlock * kChannels];
  for (int x = 0; x < width; x += kBlock) {
    hn::Vec<hn::Full128<std::uint8_t>> v[kChannels];
    for (int c = 0; c < kChannels; ++c) {
      v[c] = mirrored[c]
                 ? hn::TableLookupBytes(hn::LoadU(d, channels[c] + width - kBlock - x), backward)
                 : hn::LoadU(d, channels[c] + x);
    }
    PerfectShuffle<kChannels, Log2(kChannels)>(d, v);
    std::uint8_t* to = out + x * kChannels;
    if (x + kBlock <= width) {
      for (int c = 0; c < kChannels; ++c) hn::StoreU(v[c], d, to + c * kBlock);
    } else {
      for (int c = 0; c < kChannels; ++c) hn::Store(v[c], d, block + c * kBlock);
      std::memcpy(to, block, static_cast<std::size_t>(kChannels * (width - x)));
    }
  }
}

// The same for one direction: voxels of four bytes are written faster row by row.
void StoreRows(const Layout& layout, const std::uint8_t* const channels[4], int rows, int width,
               std::uint8_t* scratch, std::ptrdiff_t pitch, std::uint8_t* voxels) {
  for (int c = 0; c < 4; ++c) {
    std::uint8_t* to = scratch + c * kRows * pitch + kBlock;
    for (int t = 0; t < layout.steps; t += kBlock) {
      UnskewBytes<kRows>(channels[c] + t * kRows, to + t, pitch - 1);
    }
  }
  constexpr bool kMirrored[4] = {false, false, true, true};
  for (int j = 0; j < rows; ++j) {
    const std::uint8_t* of_row[4];
    for (int c = 0; c < 4; ++c) of_row[c] = scratch + (c * kRows + j) * pitch + kBlock;
    InterleaveRow(of_row, kMirrored, width, voxels + std::ptrdiff_t{4} * j * width);
  }
}

template <int kCount>
void StoreHalves(const Strip& strip) {
  StoreStrip<2 * kCount, false>(strip);
  Strip mirrored = strip;
  mirrored.channels += 2 * kCount;
  mirrored.voxels += 2 * kCount;
  StoreStrip<2 * kCount, true>(mirrored);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard

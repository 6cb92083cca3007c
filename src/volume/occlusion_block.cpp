// Blocks of the occlusion sweep.
#include <algorithm>
#include <memory>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "obscura/volume_blocks.h"
#include "volume/occlusion_kernel.h"
#include "volume/sweep_halves.h"
#include "volume/visibility_field.h"
#include "volume/volume_access.h"

namespace obscura {
namespace {

constexpr const char* kWhat = "a block of the occlusion sweep; use smaller blocks";

Status not_started() {
  return invalid_input("the block has no transmittances; call start with its distances first");
}

}  // namespace

class OcclusionBlockImpl {
 public:
  VisibilityField field;
  std::unique_ptr<std::uint8_t[]> tau;
  std::array<int, 3> volume{};               // of a shadow: the whole volume's size
  int begin = 0;                             // and the block's first plane of the turned grid
  std::unique_ptr<std::uint8_t[]> spare[2];  // memory of the block before

  // Memory of a half, whatever it holds.
  std::uint8_t* room(int half) {
    std::unique_ptr<std::uint8_t[]>& bytes = f().bytes[half];
    if (!bytes) bytes = std::move(spare[half]);
    if (!bytes) bytes.reset(new std::uint8_t[samples()]);
    return bytes.get();
  }
  void take_memory(OcclusionBlockImpl& old) {
    if (old.samples() != samples()) return;
    for (int half = 0; half < 2; ++half) {
      spare[half] = std::move(old.f().bytes[half] ? old.f().bytes[half] : old.spare[half]);
    }
    if (old.field.impl().voxels() == field.impl().voxels()) tau = std::move(old.tau);
  }

  VisibilityFieldImpl& f() { return field.impl(); }
  std::size_t samples() const { return field.impl().voxels() * field.impl().channels(); }
};

OcclusionBlock::OcclusionBlock() = default;
OcclusionBlock::~OcclusionBlock() = default;
OcclusionBlock::OcclusionBlock(OcclusionBlock&&) noexcept = default;
OcclusionBlock& OcclusionBlock::operator=(OcclusionBlock&&) noexcept = default;

Status OcclusionBlock::start(GridView<const float> distance, const OcclusionSettings& settings,
                             const RunOptions& run) {
  if (Status s = check_sweep(distance, settings); !s.ok()) return s;
  if (settings.precision != VisibilityPrecision::kU8) {
    return unsupported("precision is f32; blocks are swept as u8");
  }
  return guarded(kWhat, [&]() -> Status {
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    auto block = std::make_unique<OcclusionBlockImpl>();
    set_occlusion_grid(distance, settings, &block->f());
    block->f().scheme.plane = false;  // light() of a block goes without the table of planes
    if (impl_) block->take_memory(*impl_);
    impl_.reset();
    if (!block->tau) block->tau.reset(new std::uint8_t[block->f().voxels()]);
    occlusion_tau(distance, block->f(), threads.executor(), block->tau.get());
    impl_ = std::move(block);
    return {};
  });
}

Status shadow_planes(const std::array<int, 3>& size, const std::array<float, 3>& spacing,
                     std::array<float, 3> to_light, const OcclusionSettings& settings,
                     int* planes) {
  return guarded(kWhat, [&]() -> Status {
    if (Status s = validate_ranges(settings); !s.ok()) return s;
    if (Status s = validate_grid("volume", &size, size, spacing); !s.ok()) return s;
    if (Status s = unit_light(&to_light); !s.ok()) return s;
    VisibilityFieldImpl f;
    if (Status s = set_shadow_grid(size, spacing, to_light, settings, &f); !s.ok()) return s;
    *planes = f.size[2];
    return {};
  });
}

Status OcclusionBlock::start_shadow(const std::array<int, 3>& size,
                                    const std::array<float, 3>& spacing,
                                    std::array<float, 3> to_light,
                                    const OcclusionSettings& settings, int begin, int end) {
  int planes = 0;
  if (Status s = shadow_planes(size, spacing, to_light, settings, &planes); !s.ok()) return s;
  if (settings.precision != VisibilityPrecision::kU8) {
    return unsupported("precision is f32; blocks are swept as u8");
  }
  if (begin < 0 || begin >= end || end > planes) {
    return invalid_argument(text("the block has planes ", begin, " to ", end,
                                 "; they must be some of the turned grid's ", planes));
  }
  return guarded(kWhat, [&]() -> Status {
    if (Status s = unit_light(&to_light); !s.ok()) return s;
    auto block = std::make_unique<OcclusionBlockImpl>();
    if (Status s = set_shadow_grid(size, spacing, to_light, settings, &block->f()); !s.ok()) {
      return s;
    }
    block->f().size[2] = end - begin;
    block->volume = size;
    block->begin = begin;
    if (impl_) block->take_memory(*impl_);
    impl_.reset();
    if (!block->tau) block->tau.reset(new std::uint8_t[block->f().voxels()]);
    std::fill_n(block->tau.get(), block->f().voxels(), std::uint8_t{255});
    impl_ = std::move(block);
    return {};
  });
}

Status OcclusionBlock::shade(GridView<const float> distance, int first, const RunOptions& run) {
  if (!impl_ || !impl_->f().shadow) {
    return invalid_input("the block is none of a shadow; call start_shadow first");
  }
  if (Status s = validate_grid("distance", distance.data, distance.size, distance.spacing);
      !s.ok()) {
    return s;
  }
  const std::array<int, 3>& n = impl_->volume;
  if (distance.size[0] != n[0] || distance.size[1] != n[1] || first < 0 ||
      first > n[2] - distance.size[2]) {
    return invalid_input(text("distance holds ", distance.size[0], "x", distance.size[1], "x",
                              distance.size[2], " voxels from plane ", first,
                              " on; they must be planes of the volume's ", n[0], "x", n[1], "x",
                              n[2]));
  }
  return guarded(kWhat, [&]() -> Status {
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    shadow_tau(GridSampler(distance, first, n[2]), impl_->f(), impl_->begin, threads.executor(),
               impl_->tau.get());
    return {};
  });
}

std::span<std::uint8_t> OcclusionBlock::transmittance() {
  if (!impl_) return {};
  return {impl_->tau.get(), impl_->f().voxels()};
}

std::size_t OcclusionBlock::face_size() const {
  if (!impl_) return 0;
  const VisibilityFieldImpl& f = impl_->field.impl();
  return f.channels() * static_cast<std::size_t>(f.size[0]) * static_cast<std::size_t>(f.size[1]);
}

Status OcclusionBlock::sweep(bool rising, std::span<const std::int16_t> upwind,
                             std::span<std::int16_t> downwind, const RunOptions& run) {
  if (!impl_) return not_started();
  for (const auto& [name, given] :
       {std::pair{"upwind", upwind.size()}, {"downwind", downwind.size()}}) {
    if (given != 0 && given != face_size()) {
      return invalid_input(text(name, " holds ", given, " numbers; it must be empty or hold ",
                                face_size(), ", as face_size() says"));
    }
  }
  for (const std::int16_t w : upwind) {
    if (w < 0) return invalid_input(text("upwind holds ", w, "; it must be in [0, 32767]"));
  }
  return guarded(kWhat, [&]() -> Status {
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    VisibilityFieldImpl& f = impl_->f();
    const int half = rising ? 0 : 1;
    std::uint8_t* const visibility = impl_->room(half);
    const OcclusionSweep sweep{impl_->tau.get(),
                               f.size,
                               rising,
                               f.scheme.directions.data(),
                               f.directions(),
                               visibility,
                               upwind.empty() ? nullptr : upwind.data(),
                               downwind.empty() ? nullptr : downwind.data()};
    const int workers = std::min(executor.thread_count(), OcclusionPipeline::most_workers(sweep));
    OcclusionPipeline pipeline(std::span(&sweep, 1), workers);
    Progress progress(f.size[2], run.progress);
    executor.parallel_for(workers, [&](int worker, int) {
      if (!progress.cancelled()) pipeline.work(worker, [&] { return progress.advance(); });
    });
    if (progress.cancelled()) return sweep_cancelled();
    pipeline.finish();
    return {};
  });
}

std::span<const std::uint8_t> OcclusionBlock::half(bool rising) const {
  if (!impl_ || !impl_->field.impl().bytes[rising ? 0 : 1]) return {};
  return {impl_->field.impl().bytes[rising ? 0 : 1].get(), impl_->samples()};
}

Status OcclusionBlock::restore(bool rising, FunctionRef<Status(std::span<std::uint8_t>)> fill) {
  if (!impl_) return not_started();
  return guarded(kWhat, [&] { return fill({impl_->room(rising ? 0 : 1), impl_->samples()}); });
}

const VisibilityField& OcclusionBlock::field() const {
  static const VisibilityField kEmpty;
  return impl_ ? impl_->field : kEmpty;
}

}  // namespace obscura

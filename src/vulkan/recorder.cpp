#include <algorithm>
#include <new>

#include "core/text.h"
#include "gpu/frame.h"
#include "gpu/program.h"
#include "obscura/vulkan.h"
#include "screen/gpu.h"
#include "screen/half_resolution/gpu.h"
#include "view/check_view.h"
#include "vulkan/checks.h"
#include "vulkan/commands.h"
#include "vulkan/descriptors.h"
#include "vulkan/functions.h"
#include "vulkan/pipelines.h"

namespace obscura::vulkan {
namespace {

using gpu::FrameConstants;
using gpu::Pass;
using gpu::Slot;

}  // namespace

class Recorder::Impl {
 public:
  Impl(const Device& device, const FrameShape& shape, gpu::Program program)
      : device_(device), shape_(shape), program_(std::move(program)) {}

  Status create() {
    if (!f_.load(device_.device, device_.get_device_proc_addr)) {
      return unsupported("the device lacks functions of Vulkan 1.1");
    }
    for (VkDeviceSize bytes : program_.regions) {
      if (bytes > device_.max_storage_buffer_range) {
        return unsupported(text("the image needs a buffer of ", bytes,
                                " bytes; max_storage_buffer_range is ",
                                device_.max_storage_buffer_range));
      }
      layout_.add_region(bytes);
    }
    for (const Pass& pass : program_.passes) {
      Stage stage{};
      if (!pipelines_.find_or_make(pass, &stage.pipeline)) {
        return {StatusCode::kOutOfMemory, "the device could not make a pipeline"};
      }
      stage.sets = descriptors_.find_or_add(stage.pipeline, pass);
      stages_.push_back(stage);
      names_.push_back(pass.name);
      bytes_.push_back(bytes_of(pass));
    }
    if (!descriptors_.allocate(shape_.frames)) {
      return {StatusCode::kOutOfMemory, "the device has no descriptors left"};
    }
    return {};
  }

  VkDeviceSize scratch_bytes() const { return layout_.bytes; }
  void bind_scratch(const Scratch& scratch) { scratch_ = scratch; }
  std::span<const char* const> names() const { return names_; }
  std::span<const VkDeviceSize> bytes() const { return bytes_; }

  Status bind_images(int frame, const FrameImages& images) {
    if (Status s = check_frame(frame, shape_); !s.ok()) return s;
    if (Status s = check_memory(scratch_, "scratch memory"); !s.ok()) return s;
    if (Status s = check(images, shape_); !s.ok()) return s;
    descriptors_.write(frame, {.frame = images}, scratch_, layout_);
    bound_ |= 1u << frame;
    return {};
  }

  void record_tables(VkCommandBuffer commands) const {
    if (program_.table_region < 0 || !scratch_.buffer) return;
    const auto region = static_cast<std::size_t>(program_.table_region);
    record_upload(f_, commands, scratch_.buffer, scratch_.offset + layout_.offsets[region],
                  program_.tables);
  }

  Status record(VkCommandBuffer commands, int frame, const FrameView& view,
                const RecordOptions& options) const {
    if (Status s = check_record(frame, view); !s.ok()) return s;
    const FrameConstants whole = gpu::frame_constants(shape_, view.camera, view);
    const FrameConstants half = gpu::half_frame_constants(shape_, view);
    auto stamp = [&](std::size_t i) {
      if (!options.timestamps) return;
      f_.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, options.timestamps,
                           options.first_query + static_cast<std::uint32_t>(i));
    };
    record_wait(f_, commands);
    stamp(0);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      const Pass& pass = program_.passes[i];
      if (i > 0 && !pass.overlaps) {
        record_barrier(f_, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_ACCESS_SHADER_WRITE_BIT);
      }
      record_pass(f_, commands, pipelines_[stages_[i].pipeline],
                  descriptors_.set(stages_[i].sets, frame), pass, pass.half ? half : whole,
                  pass.push);
      stamp(i + 1);
    }
    return {};
  }

 private:
  struct Stage {
    std::size_t pipeline, sets;
  };

  Status check_record(int frame, const FrameView& view) const {
    if (Status s = check_frame(frame, shape_); !s.ok()) return s;
    if (!(bound_ >> frame & 1)) {
      return invalid_argument(text("frame ", frame, " has no images; bind_images() comes first"));
    }
    return view::check_view(view.camera, shape_.depth_kind, view.near_plane, view.far_plane);
  }

  VkDeviceSize bytes_of(const Pass& pass) const {
    if (pass.bytes > 0) return pass.bytes;
    VkDeviceSize bytes = 0;
    for (auto bound = pass.slots.begin(); bound != pass.slots.end(); ++bound) {
      const Slot& slot = bound->slot;
      if (std::any_of(pass.slots.begin(), bound, [&](const auto& b) { return b.slot == slot; })) {
        continue;
      }
      const Extent image = slot.is_result() ? shape_.visible() : shape_.size();
      bytes += slot.kind == Slot::kRegion ? layout_.sizes[static_cast<std::size_t>(slot.region)]
                                          : VkDeviceSize{4} * image.pixels();
    }
    return bytes;
  }

  const Device device_;
  const FrameShape shape_;
  const gpu::Program program_;
  Functions f_;
  ScratchLayout layout_;
  Scratch scratch_;
  Pipelines pipelines_{f_, device_};
  Descriptors descriptors_{f_, device_, pipelines_};
  std::vector<Stage> stages_;  // one per pass
  std::vector<const char*> names_;
  std::vector<VkDeviceSize> bytes_;
  std::uint32_t bound_ = 0;  // bit i: frame i has images
};

Recorder::Recorder() = default;
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Status Recorder::create(const Device& device, const MethodSettings& settings,
                        const FrameShape& shape, Recorder* recorder) {
  if (!recorder) return invalid_argument("recorder is null; it must point to a Recorder");
  if (Status s = check(device); !s.ok()) return s;
  if (Status s = gpu::check(shape); !s.ok()) return s;
  try {
    gpu::Program program;
    if (Status s = gpu::make_program(settings, shape, &program); !s.ok()) return s;
    auto impl = std::make_unique<Impl>(device, shape, std::move(program));
    if (Status s = impl->create(); !s.ok()) return s;
    recorder->impl_ = std::move(impl);
    return {};
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while creating the recorder"};
  }
}

VkDeviceSize Recorder::scratch_bytes() const { return impl_ ? impl_->scratch_bytes() : 0; }
void Recorder::bind_scratch(const Scratch& scratch) {
  if (impl_) impl_->bind_scratch(scratch);
}
Status Recorder::bind_images(int frame, const FrameImages& images) {
  return impl_ ? impl_->bind_images(frame, images)
               : invalid_argument("the recorder has not been created");
}
void Recorder::record_tables(VkCommandBuffer commands) const {
  if (impl_) impl_->record_tables(commands);
}
Status Recorder::record(VkCommandBuffer commands, int frame, const FrameView& view,
                        const RecordOptions& options) const {
  return impl_ ? impl_->record(commands, frame, view, options)
               : invalid_argument("the recorder has not been created");
}
std::span<const char* const> Recorder::pass_names() const {
  if (!impl_) return {};
  return impl_->names();
}
std::span<const VkDeviceSize> Recorder::pass_bytes() const {
  if (!impl_) return {};
  return impl_->bytes();
}

}  // namespace obscura::vulkan

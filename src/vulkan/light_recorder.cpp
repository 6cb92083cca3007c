#include <algorithm>
#include <new>

#include "core/text.h"
#include "gpu/frame.h"
#include "lighting/gpu.h"
#include "obscura/vulkan_light.h"
#include "vulkan/checks.h"
#include "vulkan/commands.h"
#include "vulkan/descriptors.h"

namespace obscura::vulkan {

class LightRecorder::Impl {
 public:
  Impl(const Device& device, const LightShape& shape, gpu::Program program)
      : device_(device), shape_(shape.frame), light_(shape), program_(std::move(program)) {}

  Status create() {
    if (!f_.load(device_.device, device_.get_device_proc_addr)) {
      return unsupported("the device lacks functions of Vulkan 1.1");
    }
    layout_.add_region(program_.regions[0]);
    if (!pipelines_.find_or_make(pass(), &pipeline_)) {
      return {StatusCode::kOutOfMemory, "the device could not make a pipeline"};
    }
    sets_ = descriptors_.find_or_add(pipeline_, pass());
    if (!descriptors_.allocate(shape_.frames)) {
      return {StatusCode::kOutOfMemory, "the device has no descriptors left"};
    }
    return {};
  }

  VkDeviceSize environment_bytes() const { return layout_.bytes; }
  void bind_environment(const Scratch& memory) { memory_ = memory; }

  Status bind_images(int frame, const LightImages& images) {
    if (Status s = check_frame(frame, shape_); !s.ok()) return s;
    if (Status s = check_memory(memory_, "environment memory"); !s.ok()) return s;
    const bool bent = std::ranges::any_of(pass().slots, [](const gpu::BoundSlot& b) {
      return b.slot == gpu::Slot(gpu::Slot::kBentNormalInput);
    });
    if (!images.visibility || !images.normals || !images.light || (bent && !images.bent_normal) ||
        (light_.albedo && !images.albedo)) {
      return invalid_argument(
          "visibility, normals, light and, if technique and shape say so, bent_normal and albedo "
          "must be given");
    }
    descriptors_.write(frame, {.frame = {.normals = images.normals}, .light = images}, memory_,
                       layout_);
    bound_ |= 1u << frame;
    return {};
  }

  Status record_environment(VkCommandBuffer commands,
                            const PreconvolvedEnvironment& environment) const {
    if (Status s = check_memory(memory_, "environment memory"); !s.ok()) return s;
    if (environment.empty()) return invalid_argument("the environment is empty");
    const std::span<const float> table = environment.table();
    if (table.size_bytes() != program_.regions[0]) {
      return invalid_argument(text("the environment's table has ", table.size(),
                                   " numbers; it must have ", program_.regions[0] / sizeof(float),
                                   " for ", light_.cells, " cells"));
    }
    record_upload(f_, commands, memory_.buffer, memory_.offset, table);
    return {};
  }

  Status record(VkCommandBuffer commands, int frame, const LightView& view,
                const RecordOptions& options) const {
    if (Status s = check_frame(frame, shape_); !s.ok()) return s;
    if (!(bound_ >> frame & 1)) {
      return invalid_argument(text("frame ", frame, " has no images; bind_images() comes first"));
    }
    gpu::LightWords push;
    if (Status s = gpu::make_light_push(view.world_from_eye, view.sun, &push); !s.ok()) return s;
    auto stamp = [&](std::uint32_t i) {
      if (!options.timestamps) return;
      f_.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, options.timestamps,
                           options.first_query + i);
    };
    record_wait(f_, commands);
    stamp(0);
    record_pass(f_, commands, pipelines_[pipeline_], descriptors_.set(sets_, frame), pass(),
                gpu::frame_constants(shape_, {}, {}), push);
    stamp(1);
    return {};
  }

  VkDeviceSize pass_bytes() const {
    const VkDeviceSize visible = shape_.visible().pixels();
    VkDeviceSize floats = 1 + 4 + 4;  // visibility, normal, light
    for (const gpu::BoundSlot& b : pass().slots) {
      const bool image =
          b.slot.kind == gpu::Slot::kBentNormalInput || b.slot.kind == gpu::Slot::kAlbedoImage;
      if (image) floats += 4;
    }
    return sizeof(float) * floats * visible + layout_.bytes;
  }

 private:
  const gpu::Pass& pass() const { return program_.passes[0]; }

  const Device device_;
  const FrameShape shape_;
  const LightShape light_;
  const gpu::Program program_;
  Functions f_;
  ScratchLayout layout_;
  Scratch memory_;
  Pipelines pipelines_{f_, device_};
  Descriptors descriptors_{f_, device_, pipelines_};
  std::size_t pipeline_ = 0, sets_ = 0;
  std::uint32_t bound_ = 0;  // bit i: frame i has images
};

LightRecorder::LightRecorder() = default;
LightRecorder::~LightRecorder() = default;
LightRecorder::LightRecorder(LightRecorder&&) noexcept = default;
LightRecorder& LightRecorder::operator=(LightRecorder&&) noexcept = default;

Status LightRecorder::create(const Device& device, const LightingSettings& settings,
                             const LightShape& shape, LightRecorder* recorder) {
  if (!recorder) return invalid_argument("recorder is null; it must point to a LightRecorder");
  if (Status s = check(device); !s.ok()) return s;
  if (Status s = gpu::check(shape.frame); !s.ok()) return s;
  try {
    gpu::Program program;
    if (Status s =
            gpu::make_light_program({settings, shape.frame, shape.albedo, shape.cells}, &program);
        !s.ok()) {
      return s;
    }
    auto impl = std::make_unique<Impl>(device, shape, std::move(program));
    if (Status s = impl->create(); !s.ok()) return s;
    recorder->impl_ = std::move(impl);
    return {};
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while creating the recorder"};
  }
}

namespace {
Status not_created() { return invalid_argument("the recorder has not been created"); }
}  // namespace

VkDeviceSize LightRecorder::environment_bytes() const {
  return impl_ ? impl_->environment_bytes() : 0;
}
void LightRecorder::bind_environment(const Scratch& memory) {
  if (impl_) impl_->bind_environment(memory);
}
Status LightRecorder::bind_images(int frame, const LightImages& images) {
  return impl_ ? impl_->bind_images(frame, images) : not_created();
}
Status LightRecorder::record_environment(VkCommandBuffer commands,
                                         const PreconvolvedEnvironment& environment) const {
  return impl_ ? impl_->record_environment(commands, environment) : not_created();
}
Status LightRecorder::record(VkCommandBuffer commands, int frame, const LightView& view,
                             const RecordOptions& options) const {
  return impl_ ? impl_->record(commands, frame, view, options) : not_created();
}
VkDeviceSize LightRecorder::pass_bytes() const { return impl_ ? impl_->pass_bytes() : 0; }

}  // namespace obscura::vulkan

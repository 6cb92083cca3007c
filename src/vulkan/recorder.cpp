#include <algorithm>
#include <cstring>
#include <new>

#include "core/text.h"
#include "gpu/frame_constants.h"
#include "gpu/program.h"
#include "obscura/vulkan.h"
#include "screen/half_resolution/gpu.h"
#include "vulkan/functions.h"

namespace obscura::vulkan {
namespace {

constexpr VkDeviceSize kAlignment = 256;  // the largest minStorageBufferOffsetAlignment allowed
constexpr std::size_t kFrameWords = sizeof(FrameConstants) / sizeof(std::uint32_t);
constexpr VkDeviceSize kMaxUpdate = 65536;  // of vkCmdUpdateBuffer

VkDeviceSize aligned(VkDeviceSize bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

// Of images.
bool writes(const Slot& slot) {
  return slot.kind == Slot::kVisibilityImage || slot.kind == Slot::kBentNormalImage;
}

VkDescriptorType type_of(const Slot& slot) {
  if (slot.kind == Slot::kRegion) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  return writes(slot) ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
}

bool same_types(const Pass& a, const Pass& b) {
  return std::ranges::equal(a.slots, b.slots, {}, type_of, type_of);
}

Status check(const Device& device, const FrameShape& s) {
  if (!device.device || !device.get_device_proc_addr) {
    return invalid_argument("device and get_device_proc_addr must be given");
  }
  if (s.width < 1 || s.height < 1 || s.width > 16384 || s.height > 16384) {
    return invalid_argument(
        text("shape is ", s.width, "x", s.height, "; each side must be in [1, 16384]"));
  }
  const GuardBand& g = s.guard_band;
  if (g.left < 0 || g.right < 0 || g.top < 0 || g.bottom < 0 || g.left + g.right >= s.width ||
      g.top + g.bottom >= s.height) {
    return invalid_argument(text("guard_band leaves nothing visible of ", s.width, "x", s.height));
  }
  if (s.frames < 1 || s.frames > 8) {
    return invalid_argument(text("frames is ", s.frames, "; it must be in [1, 8]"));
  }
  return {};
}

template <class Settings>
Status program_of(const Settings& settings, const FrameShape& shape, Program* program) {
  if constexpr (requires { settings.resolution; }) {
    if (settings.resolution == Resolution::kHalf) {
      return make_half_program(
          shape,
          [&](const FrameShape& half, Program* inner) {
            Settings full = settings;
            full.resolution = Resolution::kFull;
            return program_of(full, half, inner);
          },
          program);
    }
  }
  if constexpr (MethodInfo<Settings>::on_vulkan) {
    return make_program(settings, shape, program);
  } else {
    return unsupported(text("the method ", MethodInfo<Settings>::name, " does not run on Vulkan"));
  }
}

}  // namespace

class Recorder::Impl {
 public:
  Impl(const Device& device, const FrameShape& shape) : device_(device), shape_(shape) {}
  ~Impl() {
    if (pool_) f_.DestroyDescriptorPool(device_.device, pool_, nullptr);
    for (const Pipeline& s : pipelines_) {
      if (s.pipeline) f_.DestroyPipeline(device_.device, s.pipeline, nullptr);
      if (s.layout) f_.DestroyPipelineLayout(device_.device, s.layout, nullptr);
      if (s.set_layout) f_.DestroyDescriptorSetLayout(device_.device, s.set_layout, nullptr);
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Status create(Program program) {
    if (!f_.load(device_.device, device_.get_device_proc_addr)) {
      return unsupported("the device lacks functions of Vulkan 1.1");
    }
    program_ = std::move(program);
    for (VkDeviceSize bytes : program_.regions) {
      if (bytes > device_.max_storage_buffer_range) {
        return unsupported(text("the image needs a buffer of ", bytes,
                                " bytes; max_storage_buffer_range is ",
                                device_.max_storage_buffer_range));
      }
      offsets_.push_back(scratch_bytes_);
      scratch_bytes_ += aligned(bytes);
    }
    for (const Pass& pass : program_.passes) {
      if (!add_stage(pass)) {
        return {StatusCode::kOutOfMemory, "the device could not make a pipeline"};
      }
      names_.push_back(pass.name);
      bytes_.push_back(bytes_of(pass));
    }
    if (!make_sets()) return {StatusCode::kOutOfMemory, "the device has no descriptors left"};
    return {};
  }

  VkDeviceSize scratch_bytes() const { return scratch_bytes_; }
  void bind_scratch(const Scratch& scratch) { scratch_ = scratch; }
  std::span<const char* const> names() const { return names_; }
  std::span<const VkDeviceSize> bytes() const { return bytes_; }

  Status bind_images(int frame, const FrameImages& images) {
    if (frame < 0 || frame >= shape_.frames) {
      return invalid_argument(text("frame is ", frame, "; it must be in [0, ", shape_.frames, ")"));
    }
    if (!scratch_.buffer) return invalid_argument("scratch memory must be bound before images");
    if (!images.depth || !images.visibility || (shape_.normals && !images.normals) ||
        (shape_.directions != Directions::kNone && !images.bent_normal) ||
        (shape_.back_depth && !images.back_depth)) {
      return invalid_argument(
          "depth, visibility and, if the shape says so, normals, bent_normal and back_depth must "
          "be "
          "given");
    }
    for (const Binding& binding : bindings_) {
      for (std::size_t b = 0; b < binding.slots.size(); ++b) {
        write(binding.sets[frame], static_cast<std::uint32_t>(b), binding.slots[b], images);
      }
    }
    return {};
  }

  void record_tables(VkCommandBuffer commands) const {
    if (program_.table_region < 0) return;
    const VkDeviceSize start = scratch_.offset + offsets_[program_.table_region];
    const VkDeviceSize bytes = program_.tables.size() * sizeof(float);
    for (VkDeviceSize at = 0; at < bytes; at += kMaxUpdate) {
      f_.CmdUpdateBuffer(commands, scratch_.buffer, start + at, std::min(kMaxUpdate, bytes - at),
                         program_.tables.data() + at / sizeof(float));
    }
  }

  void record(VkCommandBuffer commands, int frame, const FrameView& view,
              const RecordOptions& options) const {
    const FrameConstants whole = constants_of(shape_, view.camera, view);
    const FrameConstants half =
        constants_of(half_, view::halve(view.camera, half_x_, half_y_), view);
    auto stamp = [&](std::size_t i) {
      if (!options.timestamps) return;
      f_.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, options.timestamps,
                           options.first_query + static_cast<std::uint32_t>(i));
    };
    barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    stamp(0);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      const Pass& pass = program_.passes[i];
      const Pipeline& p = pipelines_[stages_[i].pipeline];
      if (i > 0 && !pass.overlaps) {
        barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT);
      }
      f_.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, p.pipeline);
      f_.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, p.layout, 0, 1,
                               &bindings_[stages_[i].binding].sets[frame], 0, nullptr);
      FrameConstants constants = pass.half ? half : whole;
      constants.radius = pass.radius;
      constants.thickness = pass.thickness;
      // One call for both: calls are most of what recording costs.
      std::uint32_t push[kFrameWords + kMaxPush];
      std::memcpy(push, &constants, sizeof(constants));
      std::ranges::copy(pass.push, push + kFrameWords);
      f_.CmdPushConstants(commands, p.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                          static_cast<std::uint32_t>(sizeof(constants)) + push_bytes(pass), push);
      f_.CmdDispatch(commands, groups(pass.width, pass.group_x), groups(pass.height, pass.group_y),
                     static_cast<std::uint32_t>(pass.layers));
      stamp(i + 1);
    }
  }

 private:
  struct Pipeline {
    const Pass* made_for = nullptr;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
  };
  struct Binding {
    std::size_t pipeline;
    std::vector<Slot> slots;
    std::vector<VkDescriptorSet> sets{};  // one per frame
  };
  struct Stage {
    std::size_t pipeline, binding;
  };

  VkDeviceSize bytes_of(const Pass& pass) const {
    const VkDeviceSize whole = VkDeviceSize{4} * shape_.width * shape_.height;
    const VkDeviceSize visible = VkDeviceSize{4} * visible_width(shape_) * visible_height(shape_);
    VkDeviceSize bytes = pass.bytes;
    if (bytes > 0) return bytes;
    for (const Slot& slot : pass.slots) {
      if (slot.kind == Slot::kRegion)
        bytes += program_.regions[slot.region];
      else
        bytes += writes(slot) ? visible : whole;
    }
    return bytes;
  }
  static std::uint32_t groups(int invocations, int group) {
    return static_cast<std::uint32_t>((invocations + group - 1) / group);
  }
  static std::uint32_t push_bytes(const Pass& pass) {
    return static_cast<std::uint32_t>(pass.push.size() * sizeof(std::uint32_t));
  }

  bool add_stage(const Pass& pass) {
    const auto p = std::ranges::find_if(pipelines_, [&](const Pipeline& other) {
      return other.made_for->words().data() == pass.words().data() &&
             other.made_for->constants == pass.constants && same_types(*other.made_for, pass);
    });
    const auto pipeline = static_cast<std::size_t>(p - pipelines_.begin());
    if (p == pipelines_.end() && !make_pipeline(pass, &pipelines_.emplace_back())) return false;
    const auto b = std::ranges::find_if(bindings_, [&](const Binding& other) {
      return other.pipeline == pipeline && other.slots == pass.slots;
    });
    stages_.push_back({pipeline, static_cast<std::size_t>(b - bindings_.begin())});
    if (b == bindings_.end()) bindings_.push_back({pipeline, pass.slots});
    return true;
  }

  bool make_pipeline(const Pass& pass, Pipeline* stage) {
    stage->made_for = &pass;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Slot& slot : pass.slots) {
      bindings.push_back({.binding = static_cast<std::uint32_t>(bindings.size()),
                          .descriptorType = type_of(slot),
                          .descriptorCount = 1,
                          .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
                          .pImmutableSamplers = nullptr});
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    if (f_.CreateDescriptorSetLayout(device_.device, &set_info, nullptr, &stage->set_layout) !=
        VK_SUCCESS) {
      return false;
    }
    const VkPushConstantRange range{
        VK_SHADER_STAGE_COMPUTE_BIT, 0,
        static_cast<std::uint32_t>(sizeof(FrameConstants)) + push_bytes(pass)};
    VkPipelineLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &stage->set_layout;
    layout_info.pushConstantRangeCount = 1;
    layout_info.pPushConstantRanges = &range;
    if (f_.CreatePipelineLayout(device_.device, &layout_info, nullptr, &stage->layout) !=
        VK_SUCCESS) {
      return false;
    }
    return compile(pass, stage);
  }

  bool compile(const Pass& pass, Pipeline* stage) {
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = pass.words().size_bytes();
    module_info.pCode = pass.words().data();
    VkShaderModule module = VK_NULL_HANDLE;
    if (f_.CreateShaderModule(device_.device, &module_info, nullptr, &module) != VK_SUCCESS) {
      return false;
    }
    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < pass.constants.size(); ++i) {
      entries.push_back(
          {i, i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    }
    const VkSpecializationInfo specialization{
        static_cast<std::uint32_t>(entries.size()), entries.data(),
        pass.constants.size() * sizeof(std::uint32_t), pass.constants.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = stage->layout;
    const VkResult result = f_.CreateComputePipelines(device_.device, device_.pipeline_cache, 1,
                                                      &info, nullptr, &stage->pipeline);
    f_.DestroyShaderModule(device_.device, module, nullptr);
    return result == VK_SUCCESS;
  }

  bool make_sets() {
    const auto frames = static_cast<std::uint32_t>(shape_.frames);
    std::uint32_t count[3] = {};  // as the types below
    constexpr VkDescriptorType kTypes[] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                           VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                                           VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE};
    for (const Binding& binding : bindings_) {
      for (const Slot& slot : binding.slots) {
        for (int t = 0; t < 3; ++t) count[t] += type_of(slot) == kTypes[t] ? frames : 0;
      }
    }
    std::vector<VkDescriptorPoolSize> sizes;
    for (int t = 0; t < 3; ++t) {
      if (count[t] > 0) sizes.push_back({kTypes[t], count[t]});
    }
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = frames * static_cast<std::uint32_t>(bindings_.size());
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    if (f_.CreateDescriptorPool(device_.device, &pool_info, nullptr, &pool_) != VK_SUCCESS) {
      return false;
    }
    for (Binding& binding : bindings_) {
      const std::vector<VkDescriptorSetLayout> layouts(frames,
                                                       pipelines_[binding.pipeline].set_layout);
      binding.sets.resize(frames);
      VkDescriptorSetAllocateInfo info{};
      info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
      info.descriptorPool = pool_;
      info.descriptorSetCount = frames;
      info.pSetLayouts = layouts.data();
      if (f_.AllocateDescriptorSets(device_.device, &info, binding.sets.data()) != VK_SUCCESS) {
        return false;
      }
    }
    return true;
  }

  static VkImageView view_of(const Slot& slot, const FrameImages& images) {
    switch (slot.kind) {
      case Slot::kNormalImage:
        return images.normals;
      case Slot::kBackDepthImage:
        return images.back_depth;
      case Slot::kVisibilityImage:
        return images.visibility;
      case Slot::kBentNormalImage:
        return images.bent_normal;
      default:
        return images.depth;
    }
  }

  void write(VkDescriptorSet set, std::uint32_t binding, const Slot& slot,
             const FrameImages& images) const {
    VkWriteDescriptorSet w{};
    w.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    w.dstSet = set;
    w.dstBinding = binding;
    w.descriptorCount = 1;
    w.descriptorType = type_of(slot);
    VkDescriptorBufferInfo buffer{};
    VkDescriptorImageInfo image{};
    if (slot.kind == Slot::kRegion) {
      buffer = {scratch_.buffer, scratch_.offset + offsets_[slot.region],
                program_.regions[slot.region]};
      w.pBufferInfo = &buffer;
    } else {
      image.imageView = view_of(slot, images);
      image.imageLayout =
          writes(slot) ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
      w.pImageInfo = &image;
    }
    f_.UpdateDescriptorSets(device_.device, 1, &w, 0, nullptr);
  }

  static FrameConstants constants_of(const FrameShape& shape, const Camera& camera,
                                     const FrameView& v) {
    return {.scale_x = camera.scale_x,
            .scale_y = camera.scale_y,
            .center_u = camera.center_u,
            .center_v = camera.center_v,
            .width = shape.width,
            .height = shape.height,
            .left = shape.guard_band.left,
            .top = shape.guard_band.top,
            .visible_width = visible_width(shape),
            .visible_height = visible_height(shape),
            .near_plane = v.near_plane,
            .far_plane = v.far_plane,
            .orthographic = camera.orthographic,
            .frame_index = static_cast<int>(v.frame_index & 0xFFFF),
            .radius = 0,
            .thickness = 0};
  }

  void barrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written) const {
    const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written,
                                 VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
    f_.CmdPipelineBarrier(commands, from, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &memory, 0,
                          nullptr, 0, nullptr);
  }

  const Device device_;
  const FrameShape shape_, half_ = half_shape(shape_);
  const view::HalfAxis half_x_ = half_columns(shape_), half_y_ = half_rows(shape_);
  Functions f_;
  Program program_;
  std::vector<VkDeviceSize> offsets_;
  VkDeviceSize scratch_bytes_ = 0;
  Scratch scratch_;
  std::vector<Pipeline> pipelines_;
  std::vector<Binding> bindings_;
  std::vector<Stage> stages_;  // one per pass
  std::vector<const char*> names_;
  std::vector<VkDeviceSize> bytes_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

Recorder::Recorder() = default;
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Status Recorder::create(const Device& device, const MethodSettings& settings,
                        const FrameShape& shape, Recorder* recorder) {
  if (Status s = check(device, shape); !s.ok()) return s;
  try {
    Program program;
    if (Status s =
            std::visit([&](const auto& m) { return program_of(m, shape, &program); }, settings);
        !s.ok()) {
      return s;
    }
    auto impl = std::make_unique<Impl>(device, shape);
    if (Status s = impl->create(std::move(program)); !s.ok()) return s;
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
void Recorder::record(VkCommandBuffer commands, int frame, const FrameView& view,
                      const RecordOptions& options) const {
  if (impl_) impl_->record(commands, frame, view, options);
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

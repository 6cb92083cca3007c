#include "vulkan/descriptors.h"

#include <algorithm>

namespace obscura::vulkan {
namespace {

using gpu::BoundSlot;
using gpu::Slot;

VkImageView view_of(const Slot& slot, const BoundImages& images) {
  switch (slot.kind) {
    case Slot::kNormalImage:
      return images.frame.normals;
    case Slot::kBackDepthImage:
      return images.frame.back_depth;
    case Slot::kVisibilityImage:
      return images.frame.visibility;
    case Slot::kBentNormalImage:
      return images.frame.bent_normal;
    case Slot::kVisibilityInput:
      return images.light.visibility;
    case Slot::kBentNormalInput:
      return images.light.bent_normal;
    case Slot::kAlbedoImage:
      return images.light.albedo;
    case Slot::kLightImage:
      return images.light.light;
    default:
      return images.frame.depth;
  }
}

}  // namespace

void ScratchLayout::add_region(VkDeviceSize size) {
  sizes.push_back(size);
  offsets.push_back(bytes);
  bytes += (size + kScratchAlignment - 1) / kScratchAlignment * kScratchAlignment;
}

Descriptors::~Descriptors() {
  if (pool_) f_.DestroyDescriptorPool(device_.device, pool_, nullptr);
}

std::size_t Descriptors::find_or_add(std::size_t pipeline, const gpu::Pass& pass) {
  const auto found = std::ranges::find_if(
      entries_, [&](const Entry& e) { return e.pipeline == pipeline && e.slots == pass.slots; });
  const auto number = static_cast<std::size_t>(found - entries_.begin());
  if (found == entries_.end()) entries_.push_back({pipeline, pass.slots});
  return number;
}

bool Descriptors::make_pool(std::uint32_t frames) {
  std::vector<VkDescriptorPoolSize> sizes;
  for (const VkDescriptorType type :
       {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}) {
    std::ptrdiff_t count = 0;
    for (const Entry& e : entries_) {
      count +=
          std::ranges::count(e.slots, type, [](const BoundSlot& b) { return type_of(b.slot); });
    }
    if (count > 0) sizes.push_back({type, static_cast<std::uint32_t>(count) * frames});
  }
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = frames * static_cast<std::uint32_t>(entries_.size());
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  return f_.CreateDescriptorPool(device_.device, &info, nullptr, &pool_) == VK_SUCCESS;
}

bool Descriptors::allocate(int frames) {
  const auto count = static_cast<std::uint32_t>(frames);
  if (!make_pool(count)) return false;
  for (Entry& e : entries_) {
    const std::vector<VkDescriptorSetLayout> layouts(count, pipelines_[e.pipeline].set_layout);
    e.sets.resize(count);
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_;
    info.descriptorSetCount = count;
    info.pSetLayouts = layouts.data();
    if (f_.AllocateDescriptorSets(device_.device, &info, e.sets.data()) != VK_SUCCESS) return false;
  }
  return true;
}

void Descriptors::write(int frame, const BoundImages& images, const Scratch& scratch,
                        const ScratchLayout& layout) const {
  for (std::size_t number = 0; number < entries_.size(); ++number) {
    for (const BoundSlot& bound : entries_[number].slots) {
      write(set(number, frame), bound, images, scratch, layout);
    }
  }
}

void Descriptors::write(VkDescriptorSet set, const BoundSlot& bound, const BoundImages& images,
                        const Scratch& scratch, const ScratchLayout& layout) const {
  const Slot& slot = bound.slot;
  VkWriteDescriptorSet w{};
  w.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  w.dstSet = set;
  w.dstBinding = bound.at.binding;
  w.descriptorCount = 1;
  w.descriptorType = type_of(slot);
  VkDescriptorBufferInfo buffer{};
  VkDescriptorImageInfo image{};
  if (slot.kind == Slot::kRegion) {
    const auto region = static_cast<std::size_t>(slot.region);
    buffer = {scratch.buffer, scratch.offset + layout.offsets[region], layout.sizes[region]};
    w.pBufferInfo = &buffer;
  } else {
    image.imageView = view_of(slot, images);
    // What an estimator has written is read where it lies.
    const bool general = slot.is_result() || slot.kind == Slot::kVisibilityInput ||
                         slot.kind == Slot::kBentNormalInput;
    image.imageLayout =
        general ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    w.pImageInfo = &image;
  }
  f_.UpdateDescriptorSets(device_.device, 1, &w, 0, nullptr);
}

}  // namespace obscura::vulkan

#include "vulkan/pipelines.h"

#include <algorithm>

namespace obscura::vulkan {
namespace {

bool share_pipeline(const gpu::Pass& a, const gpu::Pass& b) {
  auto same_binding = [](const gpu::BoundSlot& x, const gpu::BoundSlot& y) {
    return x.at == y.at && type_of(x.slot) == type_of(y.slot);
  };
  return a.words().data() == b.words().data() && a.constants == b.constants &&
         std::ranges::equal(a.slots, b.slots, same_binding);
}

}  // namespace

Pipelines::~Pipelines() {
  for (const Pipeline& p : pipelines_) {
    if (p.pipeline) f_.DestroyPipeline(device_.device, p.pipeline, nullptr);
    if (p.layout) f_.DestroyPipelineLayout(device_.device, p.layout, nullptr);
    if (p.set_layout) f_.DestroyDescriptorSetLayout(device_.device, p.set_layout, nullptr);
  }
}

bool Pipelines::find_or_make(const gpu::Pass& pass, std::size_t* number) {
  const auto found = std::ranges::find_if(
      pipelines_, [&](const Pipeline& p) { return share_pipeline(*p.made_for, pass); });
  *number = static_cast<std::size_t>(found - pipelines_.begin());
  return found != pipelines_.end() || make(pass, &pipelines_.emplace_back());
}

bool Pipelines::make(const gpu::Pass& pass, Pipeline* pipeline) {
  pipeline->made_for = &pass;
  return make_layout(pass, pipeline) && compile(pass, pipeline);
}

bool Pipelines::make_layout(const gpu::Pass& pass, Pipeline* pipeline) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const gpu::BoundSlot& bound : pass.slots) {
    bindings.push_back({.binding = bound.at.binding,
                        .descriptorType = type_of(bound.slot),
                        .descriptorCount = 1,
                        .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
                        .pImmutableSamplers = nullptr});
  }
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set_info.pBindings = bindings.data();
  if (f_.CreateDescriptorSetLayout(device_.device, &set_info, nullptr, &pipeline->set_layout) !=
      VK_SUCCESS) {
    return false;
  }
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes(pass)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &pipeline->set_layout;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  return f_.CreatePipelineLayout(device_.device, &info, nullptr, &pipeline->layout) == VK_SUCCESS;
}

bool Pipelines::compile(const gpu::Pass& pass, Pipeline* pipeline) {
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = pass.words().size_bytes();
  module_info.pCode = pass.words().data();
  VkShaderModule module = VK_NULL_HANDLE;
  if (f_.CreateShaderModule(device_.device, &module_info, nullptr, &module) != VK_SUCCESS) {
    return false;
  }
  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < pass.constants.size(); ++i) {
    const std::size_t offset = i * sizeof(gpu::ConstantValue) + offsetof(gpu::ConstantValue, value);
    entries.push_back(
        {pass.constants[i].id, static_cast<std::uint32_t>(offset), sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo specialization{
      static_cast<std::uint32_t>(entries.size()), entries.data(),
      pass.constants.size() * sizeof(gpu::ConstantValue), pass.constants.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = pipeline->layout;
  const VkResult result = f_.CreateComputePipelines(device_.device, device_.pipeline_cache, 1,
                                                    &info, nullptr, &pipeline->pipeline);
  f_.DestroyShaderModule(device_.device, module, nullptr);
  return result == VK_SUCCESS;
}

}  // namespace obscura::vulkan

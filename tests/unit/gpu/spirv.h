#ifndef OBSCURA_TESTS_UNIT_GPU_SPIRV_H_
#define OBSCURA_TESTS_UNIT_GPU_SPIRV_H_

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

// What a compiled shader says of itself: the few SPIR-V instructions that lay out what a host gives
// it. Numbers are those of the SPIR-V specification.
namespace obscura {

enum class Resource { kBuffer, kSampledImage, kStorageImage, kOther };

struct SpirvLayout {
  bool valid = false;
  std::uint32_t local_size[3] = {};
  std::set<std::uint32_t> constants;           // SpecIds
  std::map<std::uint32_t, Resource> bindings;  // of descriptor set 0
  bool other_sets = false;
  std::uint32_t push_bytes = 0;  // to the end of the last member, each of four bytes
};

class SpirvReader {
 public:
  static SpirvLayout read(std::span<const std::uint32_t> words) {
    SpirvReader reader;
    if (words.size() < kHeader || words[0] != kMagic) return {};
    for (std::size_t at = kHeader; at < words.size();) {
      const std::uint32_t count = words[at] >> 16;
      if (count == 0 || at + count > words.size()) return {};
      reader.instruction(words[at] & 0xFFFF, words.subspan(at + 1, count - 1));
      at += count;
    }
    return reader.finish();
  }

 private:
  static constexpr std::uint32_t kMagic = 0x07230203, kHeader = 5;
  enum Op {
    kExecutionMode = 16,
    kTypeImage = 25,
    kTypeStruct = 30,
    kTypePointer = 32,
    kVariable = 59,
    kDecorate = 71,
    kMemberDecorate = 72
  };
  enum Decoration { kSpecId = 1, kBinding = 33, kDescriptorSet = 34, kOffset = 35 };
  static constexpr std::uint32_t kLocalSize = 17, kPushConstant = 9;

  struct Pointer {
    std::uint32_t storage, type;
  };

  void instruction(std::uint32_t op, std::span<const std::uint32_t> w) {
    switch (op) {
      case kExecutionMode:
        if (w[1] == kLocalSize) std::copy_n(w.begin() + 2, 3, layout_.local_size);
        break;
      case kTypeImage:
        // Sampled: 1 with a sampler, or read as a texture; 2 a storage image.
        types_[w[0]] = w[6] == 2 ? Resource::kStorageImage : Resource::kSampledImage;
        break;
      case kTypeStruct:
        types_[w[0]] = Resource::kBuffer;
        break;
      case kTypePointer:
        pointers_[w[0]] = {w[1], w[2]};
        break;
      case kVariable:
        variables_[w[1]] = w[0];
        break;
      case kDecorate:
        if (w[1] == kSpecId) layout_.constants.insert(w[2]);
        if (w[1] == kBinding) bindings_[w[0]] = w[2];
        if (w[1] == kDescriptorSet && w[2] != 0) layout_.other_sets = true;
        break;
      case kMemberDecorate:
        if (w[2] == kOffset) ends_[w[0]] = std::max(ends_[w[0]], w[3] + 4);
        break;
      default:
        break;
    }
  }

  SpirvLayout finish() {
    for (const auto& [variable, pointer] : variables_) {
      const Pointer& p = pointers_[pointer];
      if (p.storage == kPushConstant) layout_.push_bytes = ends_[p.type];
      const auto binding = bindings_.find(variable);
      if (binding == bindings_.end()) continue;
      const auto type = types_.find(p.type);
      layout_.bindings[binding->second] = type == types_.end() ? Resource::kOther : type->second;
    }
    layout_.valid = true;
    return layout_;
  }

  SpirvLayout layout_;
  std::map<std::uint32_t, Resource> types_;
  std::map<std::uint32_t, Pointer> pointers_;
  std::map<std::uint32_t, std::uint32_t> variables_, bindings_, ends_;
};

}  // namespace obscura

#endif  // OBSCURA_TESTS_UNIT_GPU_SPIRV_H_

#include "gpu/interface.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "gpu/frame_constants.h"
#include "shaders/all.h"
#include "tests/unit/gpu/spirv.h"

// Host and shader read the same interface headers; here what the compiled shader says is compared
// with what the host will believe.
namespace obscura::gpu {
namespace {

Resource resource_of(BindingKind kind, bool to_scratch) {
  switch (kind) {
    case BindingKind::kBuffer:
      return Resource::kBuffer;
    case BindingKind::kImage:
      return Resource::kSampledImage;
    case BindingKind::kResult:
      return to_scratch ? Resource::kBuffer : Resource::kStorageImage;
    case BindingKind::kWritten:
      return Resource::kStorageImage;
    case BindingKind::kNone:
      break;
  }
  return Resource::kOther;
}

// Sentences, none where shader and interface agree.
std::vector<std::string> differences(std::span<const std::uint32_t> words, bool to_scratch,
                                     const Interface& io) {
  std::vector<std::string> found;
  auto expect = [&](bool holds, const char* what) {
    if (!holds) found.push_back(std::string(io.name) + ": " + what);
  };
  const SpirvLayout shader = SpirvReader::read(words);
  expect(shader.valid, "not SPIR-V");
  expect(shader.local_size[0] == static_cast<std::uint32_t>(io.threads.width) &&
             shader.local_size[1] == static_cast<std::uint32_t>(io.threads.height) &&
             shader.local_size[2] == 1,
         "group size");
  std::set<std::uint32_t> constants;
  for (std::uint32_t i = 0; i < Interface::kMaxConstants; ++i) {
    if (io.constants >> i & 1) constants.insert(i);
  }
  expect(shader.constants == constants, "specialization constants");
  std::map<std::uint32_t, Resource> bindings;
  for (std::uint32_t i = 0; i < Interface::kMaxBindings; ++i) {
    if (io.bindings[i] != BindingKind::kNone) bindings[i] = resource_of(io.bindings[i], to_scratch);
  }
  expect(shader.bindings == bindings, "bindings");
  expect(!shader.other_sets, "a descriptor set other than 0");
  expect(shader.push_bytes == sizeof(FrameConstants) + io.push_bytes, "push constants");
  return found;
}

bool has_results(const Interface& io) {
  return std::ranges::find(io.bindings, BindingKind::kResult) != io.bindings.end();
}

TEST(GpuInterface, EveryShaderIsWhatItsHeaderSays) {
  int constants = 0, bindings = 0;
  for (const Shader* shader : shaders::kAll) {
    EXPECT_EQ(differences(shader->words, false, *shader->io), std::vector<std::string>());
    EXPECT_EQ(shader->to_scratch.empty(), !has_results(*shader->io)) << shader->io->name;
    if (!shader->to_scratch.empty()) {
      EXPECT_EQ(differences(shader->to_scratch, true, *shader->io), std::vector<std::string>());
    }
    constants += std::popcount(shader->io->constants);
    for (const BindingKind kind : shader->io->bindings) bindings += kind != BindingKind::kNone;
  }
  EXPECT_GT(constants, 0);
  EXPECT_GT(bindings, 0);
}

// The checker itself: an interface that is wrong in one way is found in just that way.
TEST(GpuInterface, AWrongHeaderIsFound) {
  const Shader& line = shaders::line;
  const struct {
    const char* what;
    std::function<void(Interface*)> spoil;
  } cases[] = {
      {"group size", [](Interface* io) { io->threads.width = 16; }},
      {"specialization constants", [](Interface* io) { io->constants |= 1u << 20; }},
      {"specialization constants", [](Interface* io) { io->constants &= ~1u; }},
      {"bindings", [](Interface* io) { io->bindings[4] = BindingKind::kNone; }},
      {"bindings", [](Interface* io) { io->bindings[9] = BindingKind::kBuffer; }},
      {"bindings", [](Interface* io) { io->bindings[2] = BindingKind::kImage; }},
      {"bindings", [](Interface* io) { io->bindings[0] = BindingKind::kBuffer; }},
      {"push constants", [](Interface* io) { io->push_bytes += 4; }},
  };
  ASSERT_TRUE(differences(line.words, false, *line.io).empty());
  for (const auto& c : cases) {
    Interface wrong = *line.io;
    c.spoil(&wrong);
    EXPECT_EQ(differences(line.words, false, wrong),
              std::vector<std::string>{std::string("line_io: ") + c.what});
  }
  EXPECT_FALSE(differences(line.words.first(3), false, *line.io).empty());
  EXPECT_FALSE(differences(line.words, true, *line.io).empty());
}

}  // namespace
}  // namespace obscura::gpu

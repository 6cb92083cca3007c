#include "gpu/pass.h"

#include <algorithm>

#include "core/text.h"

namespace obscura::gpu {
namespace {

Status wrong(const Pass& pass, const char* what, std::uint32_t id) {
  return {StatusCode::kInternal,
          text("pass ", pass.name, " of ", pass.shader.io->name, ": ", what, " ", id)};
}

bool fits(const BoundSlot& bound) {
  const Slot& slot = bound.slot;
  switch (bound.at.kind) {
    case BindingKind::kBuffer:
      return slot.kind == Slot::kRegion;
    case BindingKind::kImage:
      return slot.kind != Slot::kRegion && !slot.is_result();
    case BindingKind::kResult:
      return slot.kind == Slot::kRegion || slot.is_result();
    case BindingKind::kWritten:
      return slot.kind == Slot::kLightImage;
    case BindingKind::kNone:
      break;
  }
  return false;
}

}  // namespace

bool Pass::to_scratch() const {
  return std::ranges::any_of(slots, [](const BoundSlot& bound) {
    return bound.at.kind == BindingKind::kResult && bound.slot.kind == Slot::kRegion;
  });
}

Status check(const Pass& pass) {
  const Interface& io = *pass.shader.io;
  std::uint32_t constants = io.constants;
  for (const ConstantValue& c : pass.constants) {
    if (!(constants >> c.id & 1)) return wrong(pass, "no or a second constant", c.id);
    constants &= ~(1u << c.id);
  }
  if (constants) return wrong(pass, "no value of constant", std::countr_zero(constants));
  auto bindings = io.bindings;
  for (const BoundSlot& b : pass.slots) {
    BindingKind& kind = bindings[b.at.binding];
    if (kind != b.at.kind) return wrong(pass, "no or a second binding", b.at.binding);
    if (!fits(b)) return wrong(pass, "a slot of the wrong kind at binding", b.at.binding);
    if (b.at.kind == BindingKind::kResult && pass.to_scratch() == b.slot.is_result()) {
      return wrong(pass, "results in two kinds of places, at binding", b.at.binding);
    }
    kind = BindingKind::kNone;
  }
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    if (bindings[i] != BindingKind::kNone) return wrong(pass, "nothing at binding", i);
  }
  if (pass.push.size() * sizeof(std::uint32_t) != io.push_bytes) {
    return wrong(pass, "push constants of another shader, words:",
                 static_cast<std::uint32_t>(pass.push.size()));
  }
  if (pass.words().empty()) return wrong(pass, "no second form, constants:", io.constants);
  return {};
}

}  // namespace obscura::gpu

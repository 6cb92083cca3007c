#include "screen/far_field/plan.h"

#include "core/text.h"
#include "screen/far_field/lines.h"

namespace obscura {

bool SettingText<NearStep>::parse(std::string_view text, NearStep* value) {
  if (text == "adaptive") {
    *value = NearStep::adaptive();
    return true;
  }
  double number;
  if (!parse_number(text, &number) || !NearStep::kRange.contains(number)) return false;
  *value = NearStep::of(static_cast<float>(number));
  return true;
}
std::string SettingText<NearStep>::write(const NearStep& value) {
  return value.px > 0 ? write_number(value.px, true) : "adaptive";
}

namespace {

FarFieldSettings with_preset(FarFieldSettings s) {
  if (s.preset != FarFieldPreset::kNone) s.near_step = NearStep::adaptive();
  switch (s.preset) {
    case FarFieldPreset::kNone:
      break;
    case FarFieldPreset::kFast:
      s.directions = 16;
      s.segments = 1;
      s.separable = 2;
      break;
    case FarFieldPreset::kBalanced:
      s.directions = 32;
      s.segments = 1;
      s.separable = 2;
      break;
    case FarFieldPreset::kHigh:
      s.directions = 16;
      s.segments = 3;
      s.separable = 1;
      break;
  }
  return s;
}

// By the name that the caller gave it.
std::string what_shares(const FarFieldSettings& s) {
  if (s.preset == FarFieldPreset::kNone) return text("separable ", s.separable);
  return text("preset ", write_setting(s.preset));
}

}  // namespace

Status make_plan(const FarFieldSettings& given, FarFieldPlan* plan) {
  const FarFieldSettings settings = with_preset(given);
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (Status s = validate(settings.occluder); !s.ok()) return s;
  if (settings.receiver_slope == 0) {
    return invalid_argument("receiver_slope is 0; it must be -1 or 1");
  }
  const float step = settings.near_step.px;
  if (step != 0 && !NearStep::kRange.contains(step)) {
    return invalid_argument(text("near_step is ", step, "; it must be in ",
                                 to_string(NearStep::kRange), ", or 0 for adaptive"));
  }
  const int shares = settings.separable * settings.separable;
  if (settings.directions % shares != 0) {
    return invalid_argument(text("directions is ", settings.directions, "; with separable ",
                                 settings.separable, " it must be a multiple of ", shares,
                                 ", such as ", (16 + shares - 1) / shares * shares));
  }
  if (settings.separable > 1 && settings.jitter) {
    return invalid_argument(text("jitter and ", what_shares(given),
                                 " exclude each other: both share out groups of pixels"));
  }
  if (settings.occluder.kind == OccluderKind::kLayers) {
    return unsupported("the far field takes the occluders auto, solid, thickness and back-depth");
  }
  if (Status s = math::make_rho(settings.falloff, &plan->rho); !s.ok()) return s;
  plan->settings = settings;
  plan->directions = far_field::make_directions(settings);
  plan->phases = far_field::phases_of(settings);
  plan->reach = far_field::sideways_reach(plan->directions, settings.interval);
  return {};
}

}  // namespace obscura

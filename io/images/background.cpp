#include "io/images/background.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kLargestHalf = 65504;
// A value that this share of the pixels holds, this many times as far as any other, is the far
// plane that the image was cleared to.
constexpr double kLeastShare = 0.002, kFarBeyond = 10;

using Plane = std::vector<float>;

template <class Is>
std::size_t clear(Plane* plane, Is is) {
  std::size_t count = 0;
  for (float& v : *plane) {
    if (!is(v)) continue;
    v = kInf;
    ++count;
  }
  return count;
}

class Settling {
 public:
  Settling(const NothingThere& nothing, DepthInput* input) : nothing_(nothing), input_(*input) {}

  Status run() {
    Plane& depth = input_.depth;
    for (const float v : depth) given_ += v < kInf;  // not NaN either
    drop(fmt::format("depths of {:g} and beyond, which no scene has,", kNoDepth),
         [](float v) { return std::abs(v) >= kNoDepth && !std::isinf(v); });
    drop("", [](float v) { return v == -kInf; });
    const ValueList &background = nothing_.background, &invalid = nothing_.invalid;
    drop("", [&](float v) { return background.contains(v); });
    const std::size_t holes = clear(&depth, [&](float v) { return invalid.contains(v); });
    if (holes > 0) note(holes, "holes", "neither receive nor occlude");
    if (nothing_.metric && !background.none) find_by_itself();
    const bool any = std::ranges::any_of(depth, [](float v) { return v < kInf; });
    if (!any && given_ > 0) {
      return invalid_input(
          fmt::format("{}: every pixel holds a value that means no surface; see --background and "
                      "--depth-kind",
                      input_.name));
    }
    return {};
  }

 private:
  // Background where `is` holds; `what` begins the note.
  template <class Is>
  void drop(const std::string& what, Is is) {
    const std::size_t count = clear(&input_.depth, is);
    clear(&input_.back_depth, is);
    for (DepthInput::Layer& layer : input_.layers) {
      clear(&layer.front, is);
      clear(&layer.back, is);
    }
    if (count > 0 && !what.empty()) note(count, what, "are background");
  }

  void note(std::size_t count, const std::string& what, const char* meaning) {
    input_.notes.push_back(
        fmt::format("{}: {} {} ({:.3g} % of the pixels)", input_.name, what, meaning,
                    100.0 * static_cast<double>(count) / static_cast<double>(input_.depth.size())));
  }

  // What linear depth shows without being told.
  void find_by_itself() {
    Plane& depth = input_.depth;
    drop("depths of 0", [](float v) { return v == 0; });
    // The two largest, the two smallest values.
    float lowest = kInf, negative = kInf;
    std::size_t negatives = 0, positives = 0;
    bool one_negative = true;
    for (const float v : depth) {
      if (v < 0) {
        one_negative = one_negative && (negatives == 0 || v == negative);
        negative = v;
        ++negatives;
      } else if (v < kInf) {
        ++positives;
      }
      if (v < lowest) lowest = v;
    }
    if (negatives > 0 && positives == 0 && !one_negative) {
      for (float& v : depth) v = std::isinf(v) ? v : -v;
      for (float& v : input_.back_depth) v = std::isinf(v) ? v : -v;
      input_.notes.push_back(fmt::format(
          "{}: every depth is negative: it is read as -z, and its sign turned", input_.name));
    } else if (negatives > 0 && positives > 0 && one_negative) {
      drop(fmt::format("depths of {:g}", negative), [=](float v) { return v == negative; });
    }
    far_plateau();
  }

  void far_plateau() {
    float farthest = 0, next = 0;
    std::size_t count = 0;
    for (const float v : input_.depth) {
      if (!(v < kInf) || v < farthest) {
        if (v < farthest && v > next) next = v;
        continue;
      }
      if (v > farthest) {
        next = farthest;
        farthest = v;
        count = 0;
      }
      ++count;
    }
    const bool many = count >= 2 && static_cast<double>(count) >=
                                        kLeastShare * static_cast<double>(input_.depth.size());
    const bool half = nothing_.half_floats && farthest == kLargestHalf;
    const bool cleared = next > 0 && farthest >= kFarBeyond * next;
    if (!many || !(half || cleared) || next == 0) return;
    const std::string what =
        half ? fmt::format("depths of {:g}, the largest 16-bit float,", farthest)
             : fmt::format("depths of {:g}, {:.3g} times as far as all others,", farthest,
                           farthest / next);
    drop(what, [=](float v) { return v == farthest; });
    input_.notes.back() += "; --background none keeps them as a surface";
  }

  const NothingThere& nothing_;
  DepthInput& input_;
  std::size_t given_ = 0;
};

}  // namespace

bool ValueList::contains(float stored) const {
  for (const double v : values) {
    if (std::isnan(v) ? std::isnan(stored) : static_cast<float>(v) == stored) return true;
  }
  return false;
}

Status settle_background(const NothingThere& nothing, DepthInput* input) {
  return Settling(nothing, input).run();
}

}  // namespace obscura::tools

namespace obscura {

bool SettingText<tools::ValueList>::parse(std::string_view text, tools::ValueList* value) {
  tools::ValueList list;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    double v = 0;
    if (word == "none") {
      list.none = true;
    } else if (word == "nan") {
      list.values.push_back(std::numeric_limits<double>::quiet_NaN());
    } else if (parse_number(word, &v)) {
      list.values.push_back(v);
    } else {
      return false;
    }
    at = end + 1;
  }
  *value = list;
  return true;
}

std::string SettingText<tools::ValueList>::write(const tools::ValueList& value) {
  std::string text = value.none ? "none" : "";
  for (const double v : value.values) text += (text.empty() ? "" : ",") + fmt::format("{}", v);
  return text;
}

}  // namespace obscura

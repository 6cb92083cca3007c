#ifndef OBSCURA_IO_IMAGES_BACKGROUND_H_
#define OBSCURA_IO_IMAGES_BACKGROUND_H_

#include <string>
#include <vector>

#include "io/images/depth_input.h"
#include "obscura/settings.h"

namespace obscura::tools {

// Values as a file stores them: "0", "-9999,nan". The command line may repeat such an option.
struct ValueList {
  std::vector<double> values;
  bool none = false;  // the word: not even what is found by itself

  bool contains(float stored) const;
};

// How a file says that a pixel holds no surface.
struct NothingThere {
  ValueList background, invalid;
  bool metric = true;        // linear depth or distance, not NDC
  bool half_floats = false;  // depth is stored in 16 bits, whose largest value is 65504
};

// Turns every depth that means "nothing is here" into +inf, in the depth image, the back depth and
// the layers, and says so in input->notes. Always: +inf, NaN and |values| from kNoDepth on. By
// name: `background` and `invalid`. For linear depth and distance, unless `background` is none:
// 0; the one negative value among positive ones; half's largest value; and one value shared by
// many pixels, ten times and more beyond all others. Depth that is negative everywhere is -z, and
// turned. Refuses an image without any surface.
Status settle_background(const NothingThere& nothing, DepthInput* input);

}  // namespace obscura::tools

namespace obscura {

template <>
struct SettingText<tools::ValueList> {
  static constexpr const char* form = "V[,V...], nan, inf or none";
  static constexpr bool repeatable = true;
  static bool parse(std::string_view text, tools::ValueList* value);
  static std::string write(const tools::ValueList& value);
};

}  // namespace obscura

#endif  // OBSCURA_IO_IMAGES_BACKGROUND_H_

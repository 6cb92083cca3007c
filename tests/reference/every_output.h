#ifndef OBSCURA_TESTS_REFERENCE_EVERY_OUTPUT_H_
#define OBSCURA_TESTS_REFERENCE_EVERY_OUTPUT_H_

#include <vector>

#include "obscura/estimator.h"

namespace obscura::reference {

// Images for every output of an estimator, all filled with one number at first.
class EveryOutput {
 public:
  static constexpr int kOutputs = 7, kImages = 3 + 4 * 3;  // an image has one channel

  EveryOutput(Extent size, float fill)
      : size_(size), values_(static_cast<std::size_t>(kImages) * size.width * size.height, fill) {}

  const std::vector<float>& values() const { return values_; }

  // Which of the outputs below a method gives: found by asking for each alone.
  static std::vector<bool> offered(const MethodSettings& settings, const DepthField& field) {
    EveryOutput scratch(field.visible(), 0);
    std::vector<bool> given;
    for (int wanted = 0; wanted < kOutputs; ++wanted) {
      std::vector<bool> one(kOutputs);
      one[wanted] = true;
      given.push_back(compute(field, settings, scratch.outputs(one), {.threads = 1}).ok());
    }
    return given;
  }

  Outputs outputs(const std::vector<bool>& wanted) {
    Outputs all;
    int output = 0, image = 0;
    for (auto member : {&Outputs::visibility, &Outputs::cone_angle, &Outputs::standard_error}) {
      if (wanted[output++]) all.*member = view(image);
      ++image;
    }
    for (auto member : {&Outputs::bent_normal, &Outputs::uniform_integral,
                        &Outputs::cosine_integral, &Outputs::normal}) {
      if (wanted[output++]) all.*member = {view(image), view(image + 1), view(image + 2)};
      image += 3;
    }
    return all;
  }

 private:
  ImageView<float> view(int image) {
    return {values_.data() + static_cast<std::size_t>(image) * size_.width * size_.height,
            size_.width, size_.height};
  }

  Extent size_;
  std::vector<float> values_;
};

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_EVERY_OUTPUT_H_

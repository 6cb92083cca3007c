#ifndef OBSCURA_TESTS_REFERENCE_EVERY_OUTPUT_H_
#define OBSCURA_TESTS_REFERENCE_EVERY_OUTPUT_H_

#include <vector>

#include "obscura/estimator.h"

namespace obscura::reference {

// Images for every output of an estimator, all filled with one number at first.
class EveryOutput {
 public:
  static constexpr int kImages = 3 + 4 * 3;  // one channel each

  EveryOutput(Extent size, float fill)
      : size_(size), values_(static_cast<std::size_t>(kImages) * size.width * size.height, fill) {}

  const std::vector<float>& values() const { return values_; }

  // Those outputs that a method gives: found by asking for each alone.
  Outputs offered(const MethodSettings& settings, const DepthField& field) {
    Outputs all;
    auto keep = [&](auto member, auto view) {
      Outputs one;
      one.*member = view;
      std::vector<float> before = values_;
      if (compute(field, settings, one, {.threads = 1}).ok()) all.*member = view;
      values_ = before;
    };
    int image = 0;
    for (auto member : {&Outputs::visibility, &Outputs::cone_angle, &Outputs::standard_error}) {
      keep(member, view(image++));
    }
    for (auto member : {&Outputs::bent_normal, &Outputs::uniform_integral,
                        &Outputs::cosine_integral, &Outputs::normal}) {
      keep(member, VectorView<float>{view(image), view(image + 1), view(image + 2)});
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

#include "screen/volumetric/dual.h"

#include <algorithm>

namespace obscura {
namespace {

class Dual final : public Method {
 public:
  Dual(std::unique_ptr<Method> first, std::unique_ptr<Method> second, Combine combine, int width,
       int height)
      : first_(std::move(first)),
        second_(std::move(second)),
        combine_(combine),
        other_(width, height) {}

  view::Needs needs() const override { return first_->needs(); }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    const int width = g.visible().width, height = g.visible().height;
    const ImageView<float>& out = outputs.visibility;
    // Each is half of the work.
    const std::function<bool(double)> halves[] = {
        [&](double done) { return context.progress(done / 2); },
        [&](double done) { return context.progress(0.5 + done / 2); }};
    const std::function<bool(double)> none;
    auto part = [&](int i) -> const std::function<bool(double)>& {
      return context.progress ? halves[i] : none;
    };
    if (Status s = first_->run(g, {.visibility = out}, {context.executor, part(0), context.timer});
        !s.ok()) {
      return s;
    }
    const ImageView<float> other(other_.data(), width, height, other_.stride());
    if (Status s =
            second_->run(g, {.visibility = other}, {context.executor, part(1), context.timer});
        !s.ok()) {
      return s;
    }
    context.executor.parallel_for(height, [&](int y, int) {
      for (int x = 0; x < width; ++x) {
        const float a = out(x, y), b = other(x, y);
        out(x, y) = combine_ == Combine::kProduct ? a * b : std::min(a, b);
      }
    });
    return {};
  }

 private:
  std::unique_ptr<Method> first_, second_;
  const Combine combine_;
  AlignedImage<float> other_;
};

}  // namespace

std::unique_ptr<Method> make_dual(std::unique_ptr<Method> first, std::unique_ptr<Method> second,
                                  Combine combine, int width, int height) {
  return std::make_unique<Dual>(std::move(first), std::move(second), combine, width, height);
}

}  // namespace obscura

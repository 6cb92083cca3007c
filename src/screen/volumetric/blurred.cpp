#include "screen/volumetric/blurred.h"

#include "filters/bilateral/bilateral.h"

namespace obscura {
namespace {

class Blurred final : public Method {
 public:
  Blurred(std::unique_ptr<Method> method, float edge, int width, int height)
      : method_(std::move(method)), edge_(edge) {
    filter_.resize(width, height);
  }

  view::Needs needs() const override { return method_->needs(); }
  OutputKinds output_kinds() const override { return method_->output_kinds(); }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return method_->run(g, outputs, context);
    filter_.set_size(g.visible().width, g.visible().height);
    Outputs inner = outputs;
    inner.visibility = filter_.input();
    if (Status s = method_->run(g, inner, context); !s.ok()) return s;
    context.timer.time("blur",
                       [&] { filter_.run(g, edge_, context.executor, outputs.visibility); });
    return {};
  }

 private:
  std::unique_ptr<Method> method_;
  const float edge_;
  BilateralFilter filter_;
};

}  // namespace

std::unique_ptr<Method> make_blurred(std::unique_ptr<Method> method, float edge, int width,
                                     int height) {
  return std::make_unique<Blurred>(std::move(method), edge, width, height);
}

}  // namespace obscura

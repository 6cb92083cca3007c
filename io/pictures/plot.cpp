#include "io/pictures/plot.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

constexpr double kLeft = 70, kTop = 40, kWidth = 560, kHeight = 400, kLegend = 210;
// Okabe and Ito's colours, which the colour-blind can tell apart.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000", "#999933"};

std::string escaped(const std::string& s) {
  std::string out;
  for (char c : s) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

bool drawable(const std::pair<double, double>& p) {
  return p.first > 0 && p.second > 0 && std::isfinite(p.first) && std::isfinite(p.second);
}

// A logarithmic axis over the data, widened by a little.
struct Axis {
  double lo = INFINITY, hi = 0;

  void include(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  void finish() {
    if (!(lo <= hi)) lo = hi = 1;
    lo /= 1.3;
    hi *= 1.3;
  }
  double at(double v) const { return std::log(v / lo) / std::log(hi / lo); }
  // 1, 2, 5 times powers of ten; only powers where the range is wide.
  std::vector<double> ticks() const {
    std::vector<double> out;
    const bool wide = hi / lo > 1e4;
    for (double decade = std::pow(10, std::floor(std::log10(lo))); decade <= hi; decade *= 10) {
      for (double m : {1.0, 2.0, 5.0}) {
        if (m > 1 && wide) continue;
        if (decade * m >= lo && decade * m <= hi) out.push_back(decade * m);
      }
    }
    return out;
  }
};

std::string text_at(double x, double y, const std::string& s, const char* anchor,
                    const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(s));
}

}  // namespace

std::string Plot::to_svg() const {
  Axis ax, ay;
  for (const Series& s : series) {
    for (const auto& p : s.points) {
      if (!drawable(p)) continue;
      ax.include(p.first);
      ay.include(p.second);
    }
  }
  ax.finish();
  ay.finish();
  auto px = [&](double v) { return kLeft + kWidth * ax.at(v); };
  auto py = [&](double v) { return kTop + kHeight * (1 - ay.at(v)); };

  const double right = kLeft + kWidth, bottom = kTop + kHeight;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      right + kLegend, bottom + 60);
  svg += text_at(kLeft + kWidth / 2, 22, title, "middle", " font-size=\"15\"");
  for (double t : ax.ticks()) {
    svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/>\n", px(t), kTop, bottom);
    svg += text_at(px(t), bottom + 18, fmt::format("{:g}", t), "middle");
  }
  for (double t : ay.ticks()) {
    svg += fmt::format("<path d=\"M{0} {2:.1f}H{1}\" stroke=\"#ddd\"/>\n", kLeft, right, py(t));
    svg += text_at(kLeft - 6, py(t) + 4, fmt::format("{:g}", t), "end");
  }
  svg += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n",
      kLeft, kTop, kWidth, kHeight);
  svg += text_at(kLeft + kWidth / 2, bottom + 42, x_label, "middle");
  svg += text_at(20, kTop + kHeight / 2, y_label, "middle",
                 fmt::format(" transform=\"rotate(-90 20 {})\"", kTop + kHeight / 2));

  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& s = series[i];
    const char* colour = kColours[i % std::size(kColours)];
    std::string path;
    for (const auto& p : s.points) {
      if (!drawable(p)) continue;
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(p.first), py(p.second));
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", px(p.first),
                         py(p.second), colour);
    }
    if (s.line && !path.empty()) {
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", path, colour);
    }
    const double y = kTop + 10 + 20 * static_cast<double>(i);
    svg +=
        fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>\n", right + 16, y, colour);
    svg += text_at(right + 26, y + 4, s.name, "start");
  }
  return svg + "</svg>\n";
}

}  // namespace obscura::tools

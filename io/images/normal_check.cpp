#include "io/images/normal_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "fmt/format.h"
#include "io/images/rotation_fit.h"

namespace obscura::tools {
namespace {

using Vector = std::array<double, 3>;

constexpr double kDegrees = 180 / std::numbers::pi;
// Angles between a file's normals and those of its depth, in degrees. Shading normals (smooth over
// facets, bumps) have a median under the first. The mean of a convention that fits lies under the
// second and under a third of what it replaces: a mean, since a flipped z leaves all normals as
// they are that lie across the line of sight, which may be the most.
constexpr double kSuspicious = 25, kFits = 12, kRatio = 1.0 / 3;
// A rotation by less than this is no other space, but what bumps do to a fit.
constexpr double kLeastTurn = 4;
constexpr std::size_t kLeastPairs = 60, kMostPairs = 40000;

Vector sub(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool normalise(Vector* v) {
  const double length = std::sqrt(dot(*v, *v));
  if (!(length > 1e-12) || !std::isfinite(length)) return false;
  for (double& c : *v) c /= length;
  return true;
}

// Surface points of a depth image in eye space.
class Points {
 public:
  explicit Points(const DepthInput& input) : in_(input) {}

  std::optional<Vector> at(int x, int y) const {
    if (x < 0 || y < 0 || x >= in_.width || y >= in_.height) return std::nullopt;
    const Camera& c = in_.camera;
    double d = in_.depth[static_cast<std::size_t>(y) * in_.width + x];
    const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
    const double near = in_.near_plane, far = in_.far_plane;
    if (in_.depth_kind == DepthKind::kDistance && !c.orthographic) d /= std::hypot(a, b, 1.0);
    if (in_.depth_kind == DepthKind::kNdc || in_.depth_kind == DepthKind::kNdcReversed) {
      const double reversed = in_.depth_kind == DepthKind::kNdc ? 1 - d : d;
      if (c.orthographic) {
        d = near * reversed + far * (1 - reversed);
      } else {
        d = std::isinf(far) ? near / reversed
                            : near * far / (near * (1 - reversed) + far * reversed);
      }
      if (reversed <= 0) return std::nullopt;
    }
    if (!(d > 0) || !std::isfinite(d) || d >= far) return std::nullopt;
    const double s = c.orthographic ? 1 : d;
    return Vector{a * s, b * s, -d};
  }

  // The normal of a smooth piece of surface: both sides of a pixel agree, in x and in y.
  std::optional<Vector> normal(int x, int y) const {
    const auto p = at(x, y), l = at(x - 1, y), r = at(x + 1, y), u = at(x, y - 1), d = at(x, y + 1);
    if (!p || !l || !r || !u || !d) return std::nullopt;
    Vector left = sub(*p, *l), right = sub(*r, *p), up = sub(*u, *p), down = sub(*p, *d);
    Vector n = cross(sub(*r, *l), sub(*u, *d));
    Vector view{-(*p)[0], -(*p)[1], -(*p)[2]};
    if (in_.camera.orthographic) view = {0, 0, 1};
    if (!normalise(&n) || !normalise(&left) || !normalise(&right) || !normalise(&up) ||
        !normalise(&down) || !normalise(&view)) {
      return std::nullopt;
    }
    constexpr double kBend = 0.97;  // cosine of 14 degrees
    if (dot(left, right) < kBend || dot(up, down) < kBend || dot(n, view) < 0.15) {
      return std::nullopt;
    }
    return n;
  }

 private:
  const DepthInput& in_;
};

// How the components of a file's normals become those of eye space.
struct Convention {
  const char* name;
  Vector sign;
  bool packed;

  Vector apply(Vector n) const {
    for (int i = 0; i < 3; ++i) n[i] = sign[i] * (packed ? 2 * n[i] - 1 : n[i]);
    return n;
  }
};
constexpr Convention kView{"in eye space", {1, 1, 1}, false};
constexpr Convention kOthers[] = {
    {"negated, pointing away from the camera", {-1, -1, -1}, false},
    {"left-handed, with z into the scene", {1, 1, -1}, false},
    {"turned upside down, with y downwards", {1, -1, 1}, false},
    {"those of a camera with y downwards and z into the scene", {1, -1, -1}, false},
    {"packed into [0, 1]", {1, 1, 1}, true},
    {"packed into [0, 1] and negated", {-1, -1, -1}, true},
    {"packed into [0, 1], with z into the scene", {1, 1, -1}, true},
    {"packed into [0, 1], with y downwards", {1, -1, 1}, true},
};

class Check {
 public:
  explicit Check(const DepthInput& input) {
    const Points points(input);
    const std::size_t pixels = input.depth.size();
    const int step =
        std::max(1, static_cast<int>(std::sqrt(static_cast<double>(pixels) / kMostPairs)));
    for (int y = step / 2; y < input.height; y += step) {
      for (int x = step / 2; x < input.width; x += step) {
        const std::size_t i = static_cast<std::size_t>(y) * input.width + x;
        const Vector n{input.normal_x[i], input.normal_y[i], input.normal_z[i]};
        if (!std::isfinite(dot(n, n)) || dot(n, n) < 1e-12) continue;
        if (const auto truth = points.normal(x, y)) pairs_.push_back({n, *truth});
      }
    }
  }

  bool enough() const { return pairs_.size() >= kLeastPairs; }

  // Angles, in degrees, between depth's normals and what `map` makes of the file's.
  struct Angles {
    double mean, median;
  };
  template <class Map>
  Angles angles(Map map) const {
    std::vector<double> all;
    all.reserve(pairs_.size());
    double sum = 0;
    for (const auto& [n, truth] : pairs_) {
      Vector v = map(n);
      const double cosine = normalise(&v) ? std::clamp(dot(v, truth), -1.0, 1.0) : -1;
      all.push_back(std::acos(cosine) * kDegrees);
      sum += all.back();
    }
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return {sum / static_cast<double>(all.size()), *middle};
  }

  // The rotation, or rotation and reflection, that takes the file's normals to depth's; nothing
  // where they do not span space.
  std::optional<RotationFit> rotation(bool packed) const {
    double m[3][3] = {};
    for (const auto& [file, truth] : pairs_) {
      Vector n = packed ? Vector{2 * file[0] - 1, 2 * file[1] - 1, 2 * file[2] - 1} : file;
      if (!normalise(&n)) continue;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) m[i][j] += truth[i] * n[j];
      }
    }
    for (auto& row : m) {
      for (double& v : row) v /= static_cast<double>(pairs_.size());
    }
    return fit_rotation(m);
  }

 private:
  struct Pair {
    Vector file, truth;
  };
  std::vector<Pair> pairs_;
};

Vector times(const RotationFit& r, const Vector& n) {
  Vector out{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[i] += r.matrix[i][j] * n[j];
  }
  return out;
}

// Which of the world's axes is up in the image: its image has no x and a positive y.
const char* up_axis(const RotationFit& r) {
  const bool z_up = std::abs(r.matrix[0][2]) < std::abs(r.matrix[0][1]);
  return z_up ? "z up" : "y up";
}

void apply(const Convention& c, DepthInput* input) {
  for (std::size_t i = 0; i < input->normal_x.size(); ++i) {
    const Vector n = c.apply({input->normal_x[i], input->normal_y[i], input->normal_z[i]});
    input->normal_x[i] = static_cast<float>(n[0]);
    input->normal_y[i] = static_cast<float>(n[1]);
    input->normal_z[i] = static_cast<float>(n[2]);
  }
}

}  // namespace

Status check_normals(const std::string& source, bool turned_by_matrix, DepthInput* input) {
  const Check check(*input);
  if (!check.enough()) return {};
  const auto [as_given, median] = check.angles([](const Vector& n) { return kView.apply(n); });
  const std::string whose = fmt::format("{}: its normals ({})", input->name, source);
  const Convention* best = nullptr;
  double best_angle = as_given;
  for (const Convention& c : kOthers) {
    const double angle = check.angles([&](const Vector& n) { return c.apply(n); }).mean;
    if (angle < best_angle) {
      best = &c;
      best_angle = angle;
    }
  }
  const bool better = best && best_angle < kFits && best_angle < kRatio * as_given;
  if (better && as_given > kLeastTurn) {
    apply(*best, input);
    input->notes.push_back(
        fmt::format("{} are {}: mended (--normals depth does without)", whose, best->name));
    return {};
  }
  for (const bool packed : {false, true}) {
    const auto turn = check.rotation(packed);
    if (!turn) continue;
    const auto turned = [&](const Vector& n) {
      return times(*turn, packed ? Vector{2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1} : n);
    };
    const double angle = check.angles(turned).mean;
    const bool fits = angle < kFits && angle < kRatio * as_given && turn->degrees > kLeastTurn;
    if (!fits) continue;
    const std::string space =
        fmt::format("{}in world space ({}{}): the camera is turned by {:.0f} degrees",
                    packed ? "packed into [0, 1] and " : "", up_axis(*turn),
                    turn->mirrored ? ", mirrored" : "", turn->degrees);
    if (turned_by_matrix) {
      return invalid_input(
          fmt::format("{} are still {} after worldToCamera; it is not this image's, "
                      "or transposed; --normals depth does without",
                      whose, space));
    }
    for (auto* n : {&input->normal_x, &input->normal_y, &input->normal_z}) n->clear();
    input->notes.push_back(fmt::format(
        "{} are {}; normals from depth are used instead; --world-to-camera FILE makes use of the "
        "file's",
        whose, space));
    return {};
  }
  if (median <= kSuspicious) return {};
  return invalid_input(
      fmt::format("{} are {:.0f} degrees (median) off those of its depth, and no convention known "
                  "here explains "
                  "it; say --normals depth, or --normal-space view to believe them",
                  whose, median));
}

}  // namespace obscura::tools

// The scan's passes against loops over every row and line, in double.
#include "screen/far_field/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "screen/far_field/scan_kernel.h"
#include "tests/unit/screen/far_field/rough_field.h"

namespace obscura::far_field {
namespace {

// One row of a scanned line.
struct Step {
  double depth, height, back, outward;
};

// What a line finds in row `row`, counted outwards; false: no surface. The lattice between two
// texels is linear where both are surface (finite matter: and touch); otherwise the nearer decides.
bool step_of(const view::Geometry& g, const Plane& p, const Direction& d, const LineLayout& layout,
             float slope, int line, int row, Step* step) {
  const int v = d.sign > 0 ? row : p.height - 1 - row;
  const double u = line * layout.step + layout.shift(row);
  const int left = static_cast<int>(std::floor(u));
  const double blend = u - left;
  auto depth_at = [&](const AlignedImage<float>& image, int i) {
    if (i < 0 || i >= p.width) return static_cast<double>(kInf);
    return static_cast<double>(d.transposed ? image(v, i) : image(i, v));
  };
  const double a = depth_at(g.depth, left), b = depth_at(g.depth, left + 1);
  const int nearest = left + (blend >= 0.5);
  bool both = std::isfinite(a) && std::isfinite(b);
  if (p.finite && both) {
    const double gap =
        std::max(a, b) - std::min(depth_at(g.back_depth, left), depth_at(g.back_depth, left + 1));
    both = gap <= join_slack(p) * std::min(a, b);
  }
  step->depth = depth_at(g.depth, nearest);
  if (both) {
    step->depth = p.orthographic ? a + blend * (b - a) : 1 / (1 / a + blend * (1 / b - 1 / a));
  }
  if (!std::isfinite(step->depth)) return false;
  step->back = std::max(depth_at(g.back_depth, nearest), step->depth);
  step->outward = d.sign * (v - p.center_v) * p.scale_v;
  step->height = slope * step->outward * (p.orthographic ? 1 : step->depth) - step->depth;
  return true;
}

struct Found {
  double nearest = kInf, slanted = -kInf, deepest = 0;
  double begin = 0, end = 0;  // outward, of the first and the last row
  double rest_front = kInf, rest_back = 0, rest_filled = 0;  // other pieces

  void add_rest(const Found& f) {
    if (!std::isfinite(f.nearest)) return;
    rest_front = std::min(rest_front, f.nearest);
    rest_back = std::max(rest_back, f.deepest);
    rest_filled += f.deepest - f.nearest;
  }
};
Found found_in(const RawStrip& r, int at) {
  return {r.nearest[at], r.slanted[at],    r.deepest[at],   r.begin[at],
          r.end[at],     r.rest_front[at], r.rest_back[at], r.rest_filled[at]};
}

Found maxima(const std::vector<Step>& steps) {
  Found f;
  for (const Step& s : steps) {
    f.nearest = std::min(f.nearest, s.depth);
    f.slanted = std::max(f.slanted, s.height);
    f.deepest = std::max(f.deepest, s.back);
  }
  if (!steps.empty()) {
    f.begin = steps.front().outward;
    f.end = steps.back().outward;
  }
  return f;
}

struct ScanCase {
  bool orthographic, transposed;
  int phases, line_step, receiver_slope, interval;
};
std::vector<ScanCase> cases() {
  std::vector<ScanCase> all;
  for (const bool orthographic : {false, true}) {
    for (const bool transposed : {false, true}) {
      all.push_back({orthographic, transposed, 1, 1, -1, 5});
      all.push_back({orthographic, transposed, 3, 1, 1, 5});
      all.push_back({orthographic, transposed, 6, 2, -1, 4});
    }
  }
  return all;
}

// Where a strip holds a line; one outside its window is as those beside it, which see nothing.
int place_in(const RawStrip& raw, int line) {
  return std::clamp(line, raw.window.begin - 1, raw.window.end);
}

// Calls check(geometry, plane, direction, layout, buffer) for every direction of K = 8 in each
// case.
template <class Check>
void scan_all(const Occluder& occluder, const Check& check) {
  const auto executor = make_executor(2);
  for (const ScanCase& c : cases()) {
    const view::Geometry g = rough(53, 41, c.orthographic, 31);
    FarFieldSettings settings{.occluder = Occluder::solid()};
    settings.directions = 8;
    settings.interval = c.interval;
    const std::vector<Direction> directions = make_directions(settings);
    Plane plane;
    const int margin = sideways_reach(directions, c.interval) + 2 * PrefixSums::kPadding * c.phases;
    fill_plane(g, occluder, c.transposed, margin, c.phases, *executor, &plane);
    ScanBuffer buffer;
    for (const Direction& d : directions) {
      if (d.transposed != c.transposed) continue;
      const ScanSettings scan_settings{c.interval, c.receiver_slope, c.line_step};
      scan(plane, d, scan_settings, *executor, &buffer);
      sum(plane, d, scan_settings, *executor, &buffer);
      check(g, plane, d, LineLayout(plane.width, plane.height, d, c.line_step), c, &buffer);
    }
  }
}

// Rows of a strip, counted outwards.
std::pair<int, int> rows_of(const Plane& p, const Direction& d, int interval, int level,
                            int strip) {
  const int size = interval << level, start = strip * size - d.strip_offset;
  return {std::max(start, 0), std::min(start + size, p.height)};
}

TEST(Scan, FindsTheMaximaOfEveryLineAtEveryLevel) {
  std::int64_t surfaces = 0, holes = 0;
  scan_all({}, [&](const view::Geometry& g, const Plane& p, const Direction& d,
                   const LineLayout& layout, const ScanCase& c, ScanBuffer* buffer) {
    const float slope = c.receiver_slope < 0 ? 1.0f : -1.0f;
    for (int level = 0; level < buffer->levels(); ++level) {
      for (int strip = 0; strip < buffer->strips(level); ++strip) {
        const auto [first, last] = rows_of(p, d, c.interval, level, strip);
        for (int line = 0; line < layout.lines; ++line) {
          std::vector<Step> steps;
          for (int row = first; row < last; ++row) {
            Step s;
            if (step_of(g, p, d, layout, slope, line, row, &s)) steps.push_back(s);
          }
          const Found expected = maxima(steps);
          const RawStrip raw = buffer->raw(level, strip, line % buffer->phases());
          const int at = place_in(raw, line / buffer->phases());
          ++(steps.empty() ? holes : surfaces);
          if (steps.empty()) {
            ASSERT_EQ(raw.nearest[at], kInf);
            ASSERT_EQ(raw.slanted[at], -kInf);
            continue;
          }
          ASSERT_NEAR(raw.nearest[at], expected.nearest, 2e-6 * expected.nearest)
              << "level " << level << " strip " << strip << " line " << line;
          ASSERT_NEAR(raw.slanted[at], expected.slanted, 4e-6 * expected.nearest);
        }
      }
    }
  });
  EXPECT_GT(surfaces, 10000);
  EXPECT_GT(holes, 1000);
}

// A line's matter in a strip falls into runs of rows that touch; the run with the nearest point is
// what is kept, the others in sum.
TEST(Scan, KeepsTheNearestConnectedPieceOfMatter) {
  std::int64_t several = 0;
  scan_all(Occluder::back_depth(),
           [&](const view::Geometry& g, const Plane& p, const Direction& d,
               const LineLayout& layout, const ScanCase& c, ScanBuffer* buffer) {
             const float slope = c.receiver_slope < 0 ? 1.0f : -1.0f, slack = join_slack(p);
             for (int strip = 0; strip < buffer->strips(0); ++strip) {
               const auto [first, last] = rows_of(p, d, c.interval, 0, strip);
               for (int line = 0; line < layout.lines; ++line) {
                 std::vector<std::vector<Step>> runs;
                 bool open = false;
                 for (int row = first; row < last; ++row) {
                   Step s;
                   const bool surface = step_of(g, p, d, layout, slope, line, row, &s);
                   if (surface && open) {
                     const Step& t = runs.back().back();
                     open = std::max(s.depth, t.depth) - std::min(s.back, t.back) <=
                            slack * std::min(s.depth, t.depth);
                   }
                   if (surface && !open) runs.emplace_back();
                   if (surface) runs.back().push_back(s);
                   open = surface;
                 }
                 Found expected;
                 for (const auto& run : runs) {
                   const Found f = maxima(run);
                   if (f.nearest < expected.nearest) expected = f;
                 }
                 for (const auto& run : runs) {
                   const Found f = maxima(run);
                   if (f.nearest != expected.nearest) expected.add_rest(f);
                 }
                 several += runs.size() > 1;
                 const RawStrip raw = buffer->raw(0, strip, line % buffer->phases());
                 const int at = place_in(raw, line / buffer->phases());
                 if (runs.empty()) {
                   ASSERT_EQ(raw.nearest[at], kInf);
                   continue;
                 }
                 ASSERT_NEAR(raw.nearest[at], expected.nearest, 2e-6 * expected.nearest);
                 ASSERT_NEAR(raw.slanted[at], expected.slanted, 4e-6 * expected.nearest);
                 ASSERT_NEAR(raw.deepest[at], expected.deepest, 2e-6 * expected.deepest);
                 ASSERT_NEAR(raw.begin[at], expected.begin, 1e-5);
                 ASSERT_NEAR(raw.end[at], expected.end, 1e-5);
                 if (runs.size() == 1) {
                   ASSERT_EQ(raw.rest_front[at], kInf);
                 } else {
                   ASSERT_NEAR(raw.rest_front[at], expected.rest_front, 1e-5);
                   ASSERT_NEAR(raw.rest_back[at], expected.rest_back, 1e-5);
                 }
                 ASSERT_NEAR(raw.rest_filled[at], expected.rest_filled, 1e-4);
               }
             }
           });
  EXPECT_GT(several, 1000);
}

// A strip of the pyramid is made of the two below it: the nearer one's piece, and with it the other
// one's where both touch in neighbouring rows.
TEST(Scan, JoinsTouchingMatterOnTheWayUp) {
  std::int64_t joined = 0, apart = 0;
  scan_all(
      Occluder::back_depth(), [&](const view::Geometry&, const Plane& p, const Direction&,
                                  const LineLayout& layout, const ScanCase&, ScanBuffer* buffer) {
        const float slack = join_slack(p);
        for (int level = 1; level < buffer->levels(); ++level) {
          for (int strip = 0; strip < buffer->strips(level); ++strip) {
            for (int line = 0; line < layout.lines; ++line) {
              const int phase = line % buffer->phases(), at = line / buffer->phases();
              auto found = [&](int l, int s) {
                const RawStrip r = buffer->raw(l, s, phase);
                return found_in(r, place_in(r, at));
              };
              Found near = found(level - 1, 2 * strip);
              if (2 * strip + 1 < buffer->strips(level - 1)) {
                Found far = found(level - 1, 2 * strip + 1);
                const Found inner = near, outer = far;
                if (far.nearest < near.nearest) std::swap(near, far);
                near.rest_front = std::min(near.rest_front, far.rest_front);
                near.rest_back = std::max(near.rest_back, far.rest_back);
                near.rest_filled += far.rest_filled;
                const bool touch =
                    std::isfinite(far.nearest) &&
                    far.nearest - std::min(near.deepest, far.deepest) <= slack * near.nearest &&
                    outer.begin - inner.end < 1.5f * p.scale_v;
                if (!touch) near.add_rest(far);
                if (touch) {
                  near.begin = inner.begin;
                  near.end = outer.end;
                  near.slanted = std::max(near.slanted, far.slanted);
                  near.deepest = std::max(near.deepest, far.deepest);
                }
                ++(touch ? joined : apart);
              }
              const Found f = found(level, strip);
              ASSERT_EQ(f.nearest, near.nearest);
              ASSERT_EQ(f.slanted, near.slanted);
              ASSERT_EQ(f.deepest, near.deepest);
              ASSERT_EQ(f.begin, near.begin);
              ASSERT_EQ(f.end, near.end);
              ASSERT_EQ(f.rest_front, near.rest_front);
              ASSERT_EQ(f.rest_back, near.rest_back);
              ASSERT_NEAR(f.rest_filled, near.rest_filled, 1e-4);
            }
          }
        }
      });
  EXPECT_GT(joined, 1000);
  EXPECT_GT(apart, 1000);
}

TEST(Scan, SumsRunOverAllLinesBefore) {
  scan_all({}, [&](const view::Geometry&, const Plane&, const Direction&, const LineLayout& layout,
                   const ScanCase& c, ScanBuffer* buffer) {
    const double slope = c.receiver_slope < 0 ? 1 : -1;
    const int phases = buffer->phases();
    for (int level = 0; level < buffer->levels(); ++level) {
      for (int strip = 0; strip < buffer->strips(level); ++strip) {
        double depth = 0, outward = 0, count = 0;
        for (int line = 0; line <= layout.lines; ++line) {
          const PrefixSums sums = buffer->sums(level, strip, line % phases);
          const int at = std::clamp(line / phases, sums.window.begin, sums.window.end);
          ASSERT_NEAR(sums.depth[at], depth, 1e-12 * (1 + depth));
          ASSERT_NEAR(sums.outward[at], outward, 1e-5);
          ASSERT_EQ(sums.count[at], count);
          if (line == layout.lines) break;
          const RawStrip raw = buffer->raw(level, strip, line % phases);
          const int own = place_in(raw, line / phases);
          if (raw.nearest[own] == kInf) continue;
          depth += raw.nearest[own];
          // The virtual point (x, z): z = -m0 and slope x + z = m1.
          outward += slope * (double{raw.slanted[own]} + raw.nearest[own]);
          count += 1;
        }
        for (int phase = 0; phase < phases; ++phase) {
          const PrefixSums sums = buffer->sums(level, strip, phase);
          const int last = sums.window.end + PrefixSums::kPadding;
          ASSERT_EQ(sums.count[sums.window.begin - PrefixSums::kPadding], 0);
          ASSERT_EQ(sums.count[last], count);
          ASSERT_EQ(sums.depth[last], depth);
        }
      }
    }
  });
}

// 2,600 lines of depth about 1000: a mean over the last few lines keeps what the depths themselves
// hold. A running sum in float, the checker's wrong answer, does not.
TEST(Scan, SumsAreAsPreciseAsTheDepths) {
  constexpr int kLines = 2600, kPad = PrefixSums::kPadding;
  Random random(32);
  std::vector<float> nearest(kLines + 4 * kPad), slanted(nearest.size()), count(nearest.size());
  std::vector<double> depth(nearest.size()), outward(nearest.size());
  for (int i = 0; i < kLines; ++i) {
    nearest[i] = static_cast<float>(1000 + random.uniform());
    slanted[i] = -nearest[i] + static_cast<float>(100 * random.uniform());
  }
  sum_lines(kLines, 1, 0, 1.0f,
            {.nearest = nearest.data(), .slanted = slanted.data(), .window = {0, kLines}},
            {depth.data() + kPad, outward.data() + kPad, count.data() + kPad});
  double worst = 0, worst_outward = 0, worst_float = 0;
  float running = 0;
  std::vector<float> in_float(1, 0.0f);
  for (int i = 0; i < kLines; ++i) in_float.push_back(running += nearest[i]);
  for (int i = 0; i + 3 <= kLines; ++i) {
    double mean = 0, mean_outward = 0;
    for (int k = i; k < i + 3; ++k) {
      mean += nearest[k] / 3.0;
      mean_outward += (double{slanted[k]} + nearest[k]) / 3;
    }
    auto between = [&](const std::vector<double>& sums) {
      return static_cast<float>(sums[kPad + i + 3] - sums[kPad + i]) / 3;
    };
    worst = std::max(worst, std::abs(between(depth) - mean) / mean);
    worst_outward = std::max(worst_outward, std::abs(between(outward) - mean_outward));
    worst_float =
        std::max(worst_float, std::abs((in_float[i + 3] - in_float[i]) / 3 - mean) / mean);
  }
  EXPECT_LT(worst, 1e-7);
  EXPECT_LT(worst_outward, 1e-4);
  EXPECT_GT(worst_float, 2e-5);
  EXPECT_EQ(count[kPad + kLines], kLines);
}

}  // namespace
}  // namespace obscura::far_field

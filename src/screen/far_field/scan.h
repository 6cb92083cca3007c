#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_H_

#include <vector>

#include "obscura/executor.h"
#include "screen/far_field/lines.h"
#include "screen/far_field/plane.h"

namespace obscura::far_field {

// The lines of one phase that can see a surface in a strip of rows: only they are kept, for slanted
// lines of a long image pass most strips outside it. Both are multiples of a vector.
struct LineWindow {
  int begin = 0, end = 0;
};

// Sums over neighbouring lines of one strip of rows, one phase of the lines: entry i is the sum
// over all lines before the phase's line i. They may be read whole vectors at a time from kPadding
// before the window to kPadding behind it, where they go on as constants. In double, for a plain
// float sum over 2,400 lines loses 7e-5 of the depth.
struct PrefixSums {
  static constexpr int kPadding = 16;

  double* depth;    // of the nearest point per line: -m0
  double* outward;  // of the virtual point's outward coordinate: |m1 - m0|
  float* count;     // lines that saw a surface
  LineWindow window{};
};

// The same lines before they are summed, padded likewise with lines that saw nothing.
struct RawStrip {
  float* nearest = nullptr;  // -m0 per line, +inf where no surface
  float* slanted = nullptr;  // m1 per line

  // Finite occluders: depth at which the nearest connected piece of matter ends, outward
  // coordinates of its first and last row (at depth 1, or in world units), and the other pieces
  // together.
  float* deepest = nullptr;
  float *begin = nullptr, *end = nullptr;
  float *rest_front = nullptr, *rest_back = nullptr, *rest_filled = nullptr;

  LineWindow window{};
};

// The intermediate data of one direction: a pyramid of strips.
class ScanBuffer {
 public:
  // Finite occluders read single lines and need no sums, but where the matter ends.
  void resize(const Plane& plane, const Direction& direction, int interval, int line_step);

  int phases() const { return phases_; }            // of the lines
  int phase_lines() const { return phase_lines_; }  // lines per phase, rounded up
  const LineWindow& window(int level, int strip) const {
    return strips_[static_cast<std::size_t>(pyramid_.index(level, strip))].window;
  }
  const StripLevels& pyramid() const { return pyramid_; }
  int levels() const { return pyramid_.levels(); }
  int strips(int level) const { return pyramid_.strips(level); }
  int all_strips() const { return pyramid_.all(); }
  PrefixSums sums(int level, int strip, int phase);
  RawStrip raw(int level, int strip, int phase);
  // From one phase to the next.
  std::ptrdiff_t phase_stride(int level, int strip) const { return stride(window(level, strip)); }
  std::size_t bytes() const;

 private:
  struct Strip {
    LineWindow window;
    int row;  // of the images, where its lines begin
  };
  static int stride(const LineWindow& w) { return w.end - w.begin + 3 * PrefixSums::kPadding; }
  // Of line 0 of a phase, which may lie before the strip's lines.
  std::ptrdiff_t origin(const Strip& s, int phase) const;

  int phase_lines_ = 0, phases_ = 1;
  StripLevels pyramid_;
  std::vector<Strip> strips_;
  // One strip behind the other, in rows of a vector.
  AlignedImage<double> depth_, outward_;
  AlignedImage<float> count_, nearest_, slanted_, deepest_, begin_, end_;
  AlignedImage<float> rest_front_, rest_back_, rest_filled_;
};

// Relative gap in depth that joins neighbours' matter (screen/far_field/lattice_leaf.h).
float join_slack(const Plane& plane);

struct ScanSettings {
  int interval;        // B0, texels
  int receiver_slope;  // -1 or 1
  int line_step = 1;   // every n-th line is scanned; divides the plane's phases
};

// Algorithm 1 in parallel lines, and the pyramid.
void scan(const Plane& plane, const Direction& direction, const ScanSettings& settings,
          Executor& executor, ScanBuffer* buffer);

// Sums (Timonen 2013, section 7) over lines of every strip that was scanned. Finite occluders have
// none.
void sum(const Plane& plane, const Direction& direction, const ScanSettings& settings,
         Executor& executor, ScanBuffer* buffer);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_H_

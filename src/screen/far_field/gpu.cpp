#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "gpu/program.h"
#include "gpu/quads.h"
#include "math/slice_sums.h"
#include "screen/far_field/lines.h"
#include "screen/far_field/plan.h"
#include "shaders/far_field_average.h"
#include "shaders/far_field_blur.h"
#include "shaders/far_field_collect.h"
#include "shaders/far_field_evaluate.h"
#include "shaders/far_field_fill.h"
#include "shaders/far_field_gather.h"
#include "shaders/far_field_matter.h"
#include "shaders/far_field_merge.h"
#include "shaders/far_field_range.h"
#include "shaders/far_field_scan.h"
#include "shaders/far_field_sum.h"

namespace obscura::vulkan {
namespace {

using far_field::Direction;
using far_field::IntervalLines;
using far_field::LineLayout;
using far_field::Segment;
using far_field::StripLevels;

constexpr int kTile = 32;         // of far_field_fill.comp and far_field_collect.comp
constexpr int kLeastRestart = 5;  // sums restart every 32 lines or more
constexpr int kSharedLevels = 4;  // of the pyramid, that the scan makes in shared memory
// Scanned lines of one batch of directions; beyond this a batch has one direction.
constexpr VkDeviceSize kBatchBytes = VkDeviceSize{64} << 20;

// The depth image in one orientation.
struct PlaneShape {
  PlaneShape(const FrameShape& s, bool turned)
      : transposed(turned),
        width(turned ? s.height : s.width),
        height(turned ? s.width : s.height),
        left(turned ? s.guard_band.top : s.guard_band.left),
        top(turned ? s.guard_band.left : s.guard_band.top),
        visible_width(turned ? vulkan::visible_height(s) : vulkan::visible_width(s)),
        visible_height(turned ? vulkan::visible_width(s) : vulkan::visible_height(s)) {}

  bool transposed;
  int width, height, left, top, visible_width, visible_height;
  int lattice = -1, receivers = -1, sums = -1;  // regions
  int back = -1;                                // of finite occluders
  int averaged = -1, far_sums = -1;             // section 10
  int stride = 0;                               // of the lattice
};

// Directions of one orientation that are scanned, summed and evaluated together.
struct Batch {
  const PlaneShape* plane;
  std::vector<const Direction*> directions{};
  int table = 0;       // of directions
  int rows_table = 0;  // of strips to sum
  int raw_rows = 0, sum_rows = 0, lines = 0, strips = 0;
  std::vector<int> merges{};  // tables, a level each
  VkDeviceSize table_bytes = 0;
};

class FarFieldProgram {
 public:
  FarFieldProgram(const FarFieldPlan& plan, const FrameShape& shape, Program* program)
      : settings_(plan.settings),
        rho_(plan.rho),
        shape_(shape),
        directions_(plan.directions),
        phases_(plan.phases),
        margin_(plan.reach),
        sums_(shape.directions == Directions::kNone ? SliceSums::kVisibility : SliceSums::kUniform),
        program_(program) {}

  void build() {
    const Geometry g = add_geometry(shape_, true, program_);
    depth_ = back_ = g.depth;
    if (settings_.occluder.kind == OccluderKind::kBackDepth) {
      back_ = add_back_depth(shape_, program_);
    }
    normals_ = g.normals;
    rho_start_ = quads_.add_floats(rho_.table);
    tables_ = program_->table_region = program_->add_region(0);
    if (grouped()) add_average();
    add_range();
    for (PlaneShape* plane : {&planes_[0], &planes_[1]}) add_plane(plane);
    for (const PlaneShape& plane : planes_) make_batches(plane);
    VkDeviceSize raw = 1, sums = 1;
    for (const Batch& b : batches_) {
      raw = std::max(raw, raw_bytes(b));
      sums = std::max(sums, VkDeviceSize{4} * b.sum_rows * sum_stride(b));
    }
    raw_ = program_->add_region(raw);
    line_sums_ = program_->add_region(2 * sums);
    counts_ = program_->add_region(sums);
    for (Batch& b : batches_) {
      make_tables(&b);
      add_scan(b);
      finite() ? add_merge(b) : add_sum(b);
      add_evaluation(b);
    }
    add_collect();
    program_->tables = quads_.words();
    program_->regions[tables_] = program_->tables.size() * sizeof(float);
  }

 private:
  bool separable() const { return settings_.separable == 3; }
  bool finite() const { return settings_.occluder.kind != OccluderKind::kSolid; }
  // Of far_field_fill.comp.
  std::uint32_t occluder() const {
    return settings_.occluder.kind == OccluderKind::kSolid       ? 0
           : settings_.occluder.kind == OccluderKind::kThickness ? 1
                                                                 : 2;
  }
  bool grouped() const { return separable() || settings_.jitter; }
  VkDeviceSize visible_pixels() const {
    return static_cast<VkDeviceSize>(visible_width(shape_)) * visible_height(shape_);
  }
  VkDeviceSize channels() const { return sums_ == SliceSums::kVisibility ? 1 : 5; }
  int line_phases() const { return phases_ / settings_.line_step; }
  // Entries of a strip; phases are of equal length.
  int sum_stride(const Batch& b) const {
    return (b.lines + 1 + line_phases() - 1) / line_phases() * line_phases();
  }
  VkDeviceSize raw_bytes(const Batch& b) const {
    return VkDeviceSize{finite() ? 16u : 8u} * b.raw_rows * b.lines;
  }
  // Of a direction's strips, those that are there before sums; finite occluders have no sums.
  int raw_rows(const StripLevels& levels) const {
    return finite() ? levels.all() : levels.start[std::min(levels.levels(), kSharedLevels)];
  }
  int sum_rows(const StripLevels& levels) const { return finite() ? 0 : levels.all(); }
  VkDeviceSize sum_bytes(const Batch& b) const {
    return VkDeviceSize{12} * b.sum_rows * sum_stride(b);
  }
  VkDeviceSize lattice_bytes(const PlaneShape& p) const {
    return VkDeviceSize{finite() ? 8u : 4u} * p.stride * p.height;
  }
  std::uint32_t slope() const { return bits(settings_.receiver_slope < 0 ? 1.0f : -1.0f); }

  void add_range() {
    constexpr int kGroups = 256;
    const int partial = program_->add_region(kGroups * sizeof(float));
    kappa_ = program_->add_region(sizeof(float));
    for (bool last : {false, true}) {
      program_->passes.push_back(
          {.name = "fill",
           .spirv = shaders::far_field_range,
           .slots = {Slot::of(last ? partial : depth_), Slot::of(last ? kappa_ : partial)},
           .width = last ? 1 : kGroups,
           .group_x = 1,
           .push = {last ? bits(kGroups) : bits(shape_.width * shape_.height), last}});
    }
  }

  void add_plane(PlaneShape* plane) {
    PlaneShape& p = *plane;
    p.stride = p.width + 2 * margin_;
    p.lattice = program_->add_region(VkDeviceSize{4} * p.stride * p.height);
    // A binding wants a region even where the pass is specialised not to touch it.
    p.back = finite() ? program_->add_region(VkDeviceSize{4} * p.stride * p.height) : p.lattice;
    p.receivers =
        p.transposed ? program_->add_region(visible_pixels() * 4 * sizeof(float)) : normals_;
    p.sums = program_->add_region(visible_pixels() * channels() * sizeof(float));
    add_fill(p, true, normals_, p.transposed ? p.receivers : p.lattice);
    if (!separable()) return;
    p.far_sums = program_->add_region(visible_pixels() * channels() * sizeof(float));
    p.averaged = groups_;
    if (!p.transposed) return;
    p.averaged = program_->add_region(visible_pixels() * 4 * sizeof(float));
    add_fill(p, false, groups_, p.averaged);
  }

  void add_fill(const PlaneShape& p, bool lattice, int receivers, int turned) {
    program_->passes.push_back(
        {.name = "fill",
         .spirv = shaders::far_field_fill,
         .constants = {lattice, occluder()},
         .slots = {Slot::of(depth_), Slot::of(receivers), Slot::of(p.lattice), Slot::of(turned),
                   Slot::of(kappa_), Slot::of(p.back), Slot::of(back_)},
         .width = lattice ? p.stride : p.visible_width,
         .height = lattice ? p.height : p.visible_height,
         .group_x = kTile,
         .group_y = kTile,
         .thickness = settings_.occluder.thickness,
         .push = {p.transposed, bits(p.stride), bits(margin_)},
         .overlaps = p.transposed && lattice});
  }

  void add_average() {
    groups_ = program_->add_region(visible_pixels() * 4 * sizeof(float));
    accepted_ = program_->add_region(visible_pixels() * sizeof(std::uint32_t));
    program_->passes.push_back(
        {.name = "average",
         .spirv = shaders::far_field_average,
         .slots = {Slot::of(depth_), Slot::of(normals_), Slot::of(groups_), Slot::of(accepted_)},
         .width = visible_width(shape_),
         .height = visible_height(shape_),
         .group_x = 32,
         .group_y = 4});
  }

  void make_batches(const PlaneShape& plane) {
    Batch batch{.plane = &plane};
    auto flush = [&] {
      if (!batch.directions.empty()) batches_.push_back(batch);
      batch = {.plane = &plane};
    };
    for (const Direction& d : directions_) {
      if (d.transposed != plane.transposed) continue;
      const StripLevels levels(plane.height, d.phase, settings_.interval);
      const int lines = LineLayout(plane.width, plane.height, d, settings_.line_step).lines;
      Batch larger = batch;
      larger.directions.push_back(&d);
      larger.raw_rows += raw_rows(levels);
      larger.sum_rows += sum_rows(levels);
      larger.lines = std::max(larger.lines, lines);
      larger.strips = std::max(larger.strips, levels.strips(0));
      const VkDeviceSize bytes = raw_bytes(larger) + sum_bytes(larger);
      if (!batch.directions.empty() && bytes > kBatchBytes) {
        flush();
        batch.directions.push_back(&d);
        batch.raw_rows = raw_rows(levels);
        batch.sum_rows = sum_rows(levels);
        batch.lines = lines;
        batch.strips = levels.strips(0);
      } else {
        batch = larger;
      }
    }
    flush();
  }

  // Samples of one segment, which differ between receivers in their number only.
  int add_taps(const PlaneShape& p, const Direction& d, const Segment& segment) {
    const int start = quads_.size();
    for (const far_field::NearTap& tap : segment.taps) {
      const int offset = tap.dv * d.sign * p.stride + tap.du;
      quads_.add(bits(tap.along), bits(tap.wu), bits(tap.wv),
                 bits(2 * offset + far_field::is_centred(segment, &tap - segment.taps.data())));
    }
    return start;
  }

  // Two quads per row, cell, place between scanned lines and segment: taps and their number,
  // intervals and theirs; slopes.
  void add_reads(const PlaneShape& p, const Direction& d, const StripLevels& levels,
                 int direction_quad, std::vector<int>* restarts) {
    const LineLayout layout(p.width, p.height, d, settings_.line_step);
    std::vector<std::vector<int>> taps;
    for (const auto& segments : d.segments) {
      taps.emplace_back();
      for (const Segment& s : segments) taps.back().push_back(add_taps(p, d, s));
    }
    const int headers = quads_.size(), cells = static_cast<int>(d.segments.size());
    quads_.set(direction_quad + 1, 1, headers);
    const int count = p.visible_height * cells * settings_.line_step * settings_.segments;
    for (int i = 0; i < 2 * count; ++i) quads_.add(0, 0, 0, 0);
    int header = headers;
    for (int y = 0; y < p.visible_height; ++y) {
      const int v = y + p.top, row = d.sign > 0 ? v : p.height - 1 - v;
      const int near = far_field::near_rows(d, settings_.interval, row, p.height);
      for (int k = 0; k < cells * settings_.line_step; ++k) {
        const int cell = k / settings_.line_step, u = p.left + k % settings_.line_step;
        const std::vector<Segment>& segments = d.segments[cell];
        for (std::size_t s = 0; s < segments.size(); ++s, header += 2) {
          const Segment& segment = segments[s];
          const int start = quads_.size();
          const int found = add_intervals(d, segment, layout, levels, row, u, restarts);
          quads_.set(header, 0, taps[cell][s]);
          quads_.set(header, 1, far_field::count_taps(segment, row, near, p.height) | found << 16);
          quads_.set(header, 2, start);
          quads_.set(header + 1, 0, std::bit_cast<int>(segment.low));
          quads_.set(header + 1, 1, std::bit_cast<int>(segment.middle));
          quads_.set(header + 1, 2, std::bit_cast<int>(segment.high));
          quads_.set(header + 1, 3, std::bit_cast<int>(far_field::dither(d, segment)));
        }
      }
    }
    for (int i = headers + 2 * count; i < quads_.size(); ++i) {
      const int strip = quads_.get(i, 0) & 0xFFFFFF, level = quads_.get(i, 0) >> 24;
      quads_.set(i, 0, strip | (*restarts)[level] << 24);
    }
  }

  int add_intervals(const Direction& d, const Segment& segment, const LineLayout& layout,
                    const StripLevels& levels, int row, int u, std::vector<int>* restarts) {
    IntervalLines found[far_field::kMaxIntervals];
    const int count =
        far_field::find_intervals(d, segment, layout, levels, settings_.interval, row, u, found);
    for (int i = 0; i < count; ++i) {
      const IntervalLines& f = found[i];
      const int lines = f.last + 1 - f.first;
      int& restart = (*restarts)[f.level];
      while (lines > 1 << restart) ++restart;
      quads_.add(bits(levels.index(f.level, f.strip) | f.level << 24),
                 bits(finite() ? f.middle : f.first), bits(f.last + 1),
                 bits(1.0f / static_cast<float>(lines)));
    }
    return count;
  }

  void make_tables(Batch* batch) {
    Batch& b = *batch;
    const PlaneShape& p = *b.plane;
    b.table = quads_.size();
    for (std::size_t i = 0; i < 4 * b.directions.size(); ++i) quads_.add(0, 0, 0, 0);
    std::vector<std::array<std::uint32_t, 4>> strips;
    int raw_base = 0, sum_base = 0, quad = b.table;
    for (const Direction* d : b.directions) {
      const LineLayout layout(p.width, p.height, *d, settings_.line_step);
      const StripLevels levels(p.height, d->phase, settings_.interval);
      for (const auto& [word, value] :
           {std::pair{0, d->sign}, {1, d->group}, {2, d->phase}, {3, layout.lines}}) {
        quads_.set(quad, word, value);
      }
      quads_.set(quad + 1, 0, quads_.size());
      quads_.set(quad + 1, 2, finite() ? raw_base : sum_base);
      add_shifts(layout, p.height);
      for (int level = 0; level < std::min(levels.levels(), kSharedLevels); ++level) {
        quads_.set(quad + 2, level, levels.strips(level));
        quads_.set(quad + 3, level, raw_base + levels.start[level]);
      }
      std::vector<int> restarts(levels.levels(), kLeastRestart);
      add_reads(p, *d, levels, quad, &restarts);
      for (int level = 0; level < (finite() ? 0 : levels.levels()); ++level) {
        const int shared = std::min(level, kSharedLevels - 1), merged = 1 << (level - shared);
        for (int strip = 0; strip < levels.strips(level); ++strip) {
          const int first = strip * merged;
          const int count = std::min(merged, levels.strips(shared) - first);
          strips.push_back({bits(raw_base + levels.start[shared] + first), bits(count),
                            bits(layout.lines), bits(restarts[level])});
        }
      }
      raw_base += raw_rows(levels);
      sum_base += sum_rows(levels);
      quad += 4;
    }
    if (finite()) add_merges(&b);
    b.rows_table = quads_.size();
    for (const auto& s : strips) quads_.add(s[0], s[1], s[2], s[3]);
    b.table_bytes = VkDeviceSize{16} * (quads_.size() - b.table);
  }

  // Per level beyond the scan's, for each direction: its first strip and their number, and the same
  // of the level below.
  void add_merges(Batch* batch) {
    int deepest = 0;
    std::vector<StripLevels> pyramids;
    for (const Direction* d : batch->directions) {
      pyramids.emplace_back(batch->plane->height, d->phase, settings_.interval);
      deepest = std::max(deepest, pyramids.back().levels());
    }
    for (int level = kSharedLevels; level < deepest; ++level) {
      batch->merges.push_back(quads_.size());
      int base = 0;
      for (const StripLevels& p : pyramids) {
        if (level < p.levels()) {
          quads_.add(bits(base + p.start[level]), bits(p.strips(level)),
                     bits(base + p.start[level - 1]), bits(p.strips(level - 1)));
        } else {
          quads_.add(0, 0, 0, 0);
        }
        base += p.all();
      }
    }
  }

  // Two rows per quad: where line 0 crosses them, in whole texels and what is left.
  void add_shifts(const LineLayout& layout, int height) {
    auto at = [&](int row) {
      const double shift = layout.shift(row), whole = std::floor(shift);
      return std::pair{bits(static_cast<int>(whole)), bits(static_cast<float>(shift - whole))};
    };
    for (int row = 0; row < height; row += 2) {
      const auto [a, b] = at(row);
      const auto [c, d] = at(row + 1);
      quads_.add(a, b, c, d);
    }
  }

  void add_scan(const Batch& b) {
    const PlaneShape& p = *b.plane;
    program_->passes.push_back({.name = "scan",
                                .spirv = shaders::far_field_scan,
                                .constants = {bits(settings_.interval), finite()},
                                .slots = {Slot::of(tables_), Slot::of(kappa_), Slot::of(p.lattice),
                                          Slot::of(p.back), Slot::of(raw_), Slot::of(raw_)},
                                .width = b.lines,
                                .height = b.strips,
                                .layers = static_cast<int>(b.directions.size()),
                                .group_x = 32,
                                .group_y = 8,
                                .push = {p.transposed, bits(p.stride), bits(margin_), bits(b.table),
                                         bits(b.lines), bits(settings_.line_step), slope()},
                                .bytes = lattice_bytes(p) + raw_bytes(b)});
  }

  void add_merge(const Batch& b) {
    int strips = b.strips >> (kSharedLevels - 1);
    for (int table : b.merges) {
      strips = (strips + 2) / 2;
      program_->passes.push_back({.name = "scan",
                                  .spirv = shaders::far_field_merge,
                                  .slots = {Slot::of(tables_), Slot::of(raw_)},
                                  .width = b.lines,
                                  .height = strips,
                                  .layers = static_cast<int>(b.directions.size()),
                                  .group_x = 32,
                                  .group_y = 8,
                                  .push = {bits(table), bits(b.lines)}});
    }
  }

  void add_sum(const Batch& b) {
    program_->passes.push_back(
        {.name = "sum",
         .spirv = shaders::far_field_sum,
         .slots = {Slot::of(tables_), Slot::of(raw_), Slot::of(line_sums_), Slot::of(counts_)},
         .width = b.sum_rows,
         .group_x = 1,
         .push = {bits(b.rows_table), bits(b.lines), bits(sum_stride(b)), bits(line_phases()),
                  slope()},
         .bytes = raw_bytes(b) + sum_bytes(b)});
  }

  // Of far_field_evaluate.comp.
  enum Mode : std::uint32_t { kWhole, kNearAlone, kFarAlone };

  void add_evaluation(const Batch& b) {
    const PlaneShape& p = *b.plane;
    if (separable()) {
      // Without a near field the first batch makes the sums zero.
      const bool near = settings_.near_field || !filled_[p.transposed];
      if (near) add_evaluation(b, kNearAlone, p.receivers, p.sums);
      add_evaluation(b, kFarAlone, p.averaged, p.far_sums);
      program_->passes.back().overlaps = near;
    } else {
      add_evaluation(b, kWhole, p.receivers, p.sums);
    }
    filled_[p.transposed] = true;
  }

  // Lines, lattice, receivers and sums, which are read where an earlier batch has begun them.
  VkDeviceSize evaluation_bytes(const Batch& b, Mode mode) const {
    const VkDeviceSize lines = finite() ? raw_bytes(b) : sum_bytes(b);
    const VkDeviceSize sums = 4 * channels() * (filled_[b.plane->transposed] ? 2 : 1);
    return (mode == kNearAlone ? 0 : lines) + b.table_bytes + lattice_bytes(*b.plane) +
           visible_pixels() * (16 + sums);
  }

  void add_evaluation(const Batch& b, Mode mode, int receivers, int sums) {
    const PlaneShape& p = *b.plane;
    const int phases = mode == kNearAlone ? 1 : phases_;
    const int directions =
        mode == kNearAlone && !settings_.near_field ? 0 : static_cast<int>(b.directions.size());
    program_->passes.push_back(
        {.name = "evaluate",
         .spirv = finite() ? shaders::far_field_matter : shaders::far_field_evaluate,
         .constants = {static_cast<std::uint32_t>(rho_.kind),
                       settings_.profile == SlabProfile::kAdaptiveChord,
                       static_cast<std::uint32_t>(sums_), mode, bits(phases_),
                       bits(settings_.line_step), bits(settings_.segments), settings_.jitter},
         .slots = {Slot::of(tables_), Slot::of(kappa_), Slot::of(p.lattice), Slot::of(receivers),
                   Slot::of(sums), Slot::of(finite() ? p.back : line_sums_),
                   Slot::of(finite() ? raw_ : counts_)},
         .width = (p.visible_width + phases - 1) / phases,
         .height = p.visible_height,
         .layers = phases,
         .group_x = 32,
         .group_y = 4,
         .push = {bits(rho_.radius), bits(rho_.inverse_radius), bits(rho_.entries_per_length),
                  bits(rho_.last_entry), bits(rho_start_), p.transposed, bits(p.stride),
                  bits(margin_), bits(b.table), bits(directions),
                  bits(finite() ? b.lines : sum_stride(b)), filled_[p.transposed], slope()},
         .bytes = evaluation_bytes(b, mode)});
  }

  // What passes that may be the last have in common.
  Pass last_pass(const char* name, const Shader& spirv, std::vector<Slot> slots, int tile_width,
                 int tile_height) const {
    slots.push_back(Slot::image(Slot::kVisibilityImage));
    slots.push_back(Slot::image(sums_ == SliceSums::kVisibility ? Slot::kVisibilityImage
                                                                : Slot::kBentNormalImage));
    return {.name = name,
            .spirv = spirv,
            .constants = {static_cast<std::uint32_t>(sums_), settings_.cone == ConeEstimate::kPaper,
                          shape_.directions == Directions::kUnsigned},
            .slots = slots,
            .width = visible_width(shape_),
            .height = visible_height(shape_),
            .group_x = tile_width,
            .group_y = tile_height};
  }

  void add_collect() {
    if (!grouped()) {
      add_collect("write", planes_[0].sums, planes_[1].sums, -1);
      return;
    }
    const bool blur = settings_.blur;
    const int totals = blur || separable()
                           ? program_->add_region(visible_pixels() * channels() * sizeof(float))
                           : -1;
    add_collect("collect", planes_[0].sums, planes_[1].sums, totals);
    if (separable()) add_gather(totals, !blur);
    if (blur) {
      program_->passes.push_back(
          last_pass("blur", shaders::far_field_blur,
                    {Slot::of(normals_), Slot::of(groups_), Slot::of(totals)}, 32, 8));
    }
  }

  // To the images, or to a region of totals.
  void add_collect(const char* name, int straight, int turned, int totals) {
    const bool to_image = totals < 0;
    Pass pass = last_pass(name, shaders::far_field_collect,
                          {Slot::of(normals_), Slot::of(straight), Slot::of(turned),
                           Slot::of(to_image ? straight : totals)},
                          kTile, kTile);
    pass.constants.push_back(to_image);
    program_->passes.push_back(std::move(pass));
  }

  void add_gather(int totals, bool to_image) {
    const int far = program_->add_region(visible_pixels() * channels() * sizeof(float));
    add_collect("collect", planes_[0].far_sums, planes_[1].far_sums, far);
    program_->passes.back().overlaps = true;
    Pass pass = last_pass(
        "gather", shaders::far_field_gather,
        {Slot::of(normals_), Slot::of(accepted_), Slot::of(far), Slot::of(totals)}, 32, 4);
    pass.constants.push_back(to_image);
    program_->passes.push_back(std::move(pass));
  }

  const FarFieldSettings& settings_;
  const math::Rho& rho_;
  const FrameShape& shape_;
  const std::vector<Direction> directions_;
  const int phases_, margin_;
  const SliceSums sums_;
  Program* program_;
  PlaneShape planes_[2] = {{shape_, false}, {shape_, true}};
  std::vector<Batch> batches_;
  Quads quads_;
  int rho_start_ = 0;
  bool filled_[2] = {};  // a batch has written the orientation's sums
  int depth_ = -1, back_ = -1, normals_ = -1, tables_ = -1, kappa_ = -1;
  int groups_ = -1, accepted_ = -1;
  int raw_ = -1, line_sums_ = -1, counts_ = -1;
};

Status check(const FarFieldSettings& s, const FrameShape& shape) {
  if (s.occluder.kind == OccluderKind::kBackDepth && !shape.back_depth) {
    return invalid_argument("the occluder is back-depth, but the shape has no image of it");
  }
  if (shape.normal_use == NormalUse::kNone) {
    return unsupported("far-field needs normals; normal_use is none");
  }
  return {};
}

}  // namespace

template <>
Status make_program(const FarFieldSettings& given, const FrameShape& shape, Program* program) {
  FarFieldPlan plan;
  if (Status s = make_plan(given, &plan); !s.ok()) return s;
  if (Status s = check(plan.settings, shape); !s.ok()) return s;
  FarFieldProgram(plan, shape, program).build();
  return {};
}

}  // namespace obscura::vulkan

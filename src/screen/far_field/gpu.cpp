#include <algorithm>
#include <utility>

#include "gpu/quads.h"
#include "math/slice_sums.h"
#include "screen/far_field/gpu_tables.h"
#include "screen/far_field/plan.h"
#include "screen/far_field/share.h"
#include "screen/gpu.h"
#include "shaders/far_field_blur.h"
#include "shaders/far_field_collect.h"
#include "shaders/far_field_evaluate.h"
#include "shaders/far_field_fill.h"
#include "shaders/far_field_gather.h"
#include "shaders/far_field_matter.h"
#include "shaders/far_field_merge.h"
#include "shaders/far_field_scan.h"
#include "shaders/far_field_share.h"
#include "shaders/far_field_sum.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

// The regions of one orientation.
struct PlaneRegions {
  int lattice = -1, receivers = -1, sums = -1;
  int back = -1;        // of finite occluders
  bool filled = false;  // a batch has written the sums
};

class FarFieldProgram {
 public:
  FarFieldProgram(const FarFieldPlan& plan, const Frame& frame, Program* program)
      : settings_(plan.settings),
        rho_(plan.rho),
        frame_(frame),
        tables_(plan, frame.shape),
        sums_(frame.directions() ? SliceSums::kUniform : SliceSums::kVisibility),
        program_(program) {}

  void build() {
    const Geometry g = add_geometry(frame_, true, program_);
    depth_ = back_ = g.depth;
    if (occluder_kind() == far_field_fill_io::kWithBack) {
      back_ = add_back_depth(frame_, g, program_);
    }
    normals_ = g.normals;
    program_->add_table(tables_.words());
    if (settings_.separable > 1) add_share();
    for (bool turned : {false, true}) add_plane(tables_.plane(turned));
    std::uint64_t raw = 1, sums = 1;
    for (const Batch& b : tables_.batches()) {
      raw = std::max(raw, tables_.raw_bytes(b));
      sums = std::max(sums, std::uint64_t{4} * b.sum_rows * tables_.sum_stride(b));
    }
    raw_ = program_->add_region(raw);
    line_sums_ = program_->add_region(2 * sums);
    counts_ = program_->add_region(sums);
    for (const Batch& b : tables_.batches()) {
      add_scan(b);
      finite() ? add_merge(b) : add_sum(b);
      add_evaluation(b);
    }
    add_collect();
  }

 private:
  bool finite() const { return settings_.occluder.kind != OccluderKind::kSolid; }
  // Floats of a pixel's sums.
  int channels() const { return sums_ == SliceSums::kVisibility ? 1 : 5; }
  int add_sums_region() { return program_->add_region(frame_.visible_bytes(channels())); }
  int tables() const { return program_->table_region; }
  PlaneRegions& regions(const PlaneShape& p) { return regions_[p.transposed]; }
  const PlaneRegions& regions(const PlaneShape& p) const { return regions_[p.transposed]; }
  std::uint64_t lattice_bytes(const PlaneShape& p) const {
    return std::uint64_t{finite() ? 8u : 4u} * p.stride * p.height;
  }
  float slope() const { return settings_.receiver_slope < 0 ? 1.0f : -1.0f; }

  int tile() const { return far_field::tile_of_phases(tables_.phases()); }

  void add_share() {
    namespace io = far_field_share_io;
    const Extent visible = frame_.visible();
    const Extent tiles{(visible.width + tile() - 1) / tile(),
                       (visible.height + tile() - 1) / tile()};
    dense_ = program_->add_region(std::uint64_t{4} * tiles.width * tiles.height);
    program_->add(
        {.name = "share",
         .shader = shaders::far_field_share,
         .constants = {{io::kSide, settings_.separable},
                       {io::kTilePixels, tile()},
                       {io::kRowStep, far_field::kKnownStep}},
         .slots = {{io::kDepthAt, depth_}, {io::kNormalsAt, normals_}, {io::kDenseAt, dense_}},
         .size = tiles});
  }

  void add_plane(const PlaneShape& p) {
    PlaneRegions& r = regions(p);
    const std::uint64_t bytes = std::uint64_t{4} * p.stride * p.height;
    r.lattice = program_->add_region(bytes);
    // A binding wants a region even where the pass is specialised not to touch it.
    r.back = finite() ? program_->add_region(bytes) : r.lattice;
    r.receivers = p.transposed ? program_->add_region(frame_.visible_bytes(4)) : normals_;
    r.sums = add_sums_region();
    add_fill(p);
  }

  int occluder_kind() const {
    namespace io = far_field_fill_io;
    return settings_.occluder.kind == OccluderKind::kSolid       ? io::kSolid
           : settings_.occluder.kind == OccluderKind::kThickness ? io::kOfThickness
                                                                 : io::kWithBack;
  }

  void add_fill(const PlaneShape& p) {
    namespace io = far_field_fill_io;
    const PlaneRegions& r = regions(p);
    program_->add(
        {.name = "fill",
         .shader = shaders::far_field_fill,
         .constants = {{io::kOccluder, occluder_kind()}},
         .slots = {{io::kDepthAt, depth_},
                   {io::kReceiversAt, normals_},
                   {io::kLatticeAt, r.lattice},
                   {io::kTurnedAt, p.transposed ? r.receivers : r.lattice},
                   {io::kBackAt, r.back},
                   {io::kGivenBackAt, back_}},
         .size = {p.stride, p.height},
         .thickness = settings_.occluder.thickness,
         .push = push_words(io::Push{
             .transposed = p.transposed, .lattice_stride = p.stride, .margin = tables_.margin()}),
         .overlaps = p.transposed});
  }

  void add_scan(const Batch& b) {
    namespace io = far_field_scan_io;
    const PlaneShape& p = *b.plane;
    program_->add({.name = "scan",
                   .shader = shaders::far_field_scan,
                   .constants = {{io::kInterval, settings_.interval}, {io::kFinite, finite()}},
                   .slots = {{io::kTablesAt, tables()},
                             {io::kLatticeAt, regions(p).lattice},
                             {io::kBackAt, regions(p).back},
                             {io::kRawAt, raw_},
                             {io::kPiecesAt, raw_}},
                   .size = {b.lines, b.strips},
                   .layers = static_cast<int>(b.directions.size()),
                   .push = push_words(io::Push{.transposed = p.transposed,
                                               .lattice_stride = p.stride,
                                               .margin = tables_.margin(),
                                               .directions = b.table,
                                               .line_stride = b.lines,
                                               .line_step = settings_.line_step,
                                               .slope = slope()}),
                   .bytes = lattice_bytes(p) + tables_.raw_bytes(b)});
  }

  void add_merge(const Batch& b) {
    namespace io = far_field_merge_io;
    int strips = b.strips >> (far_field_scan_io::kSharedLevels - 1);
    for (int table : b.merges) {
      strips = (strips + 2) / 2;
      program_->add(
          {.name = "scan",
           .shader = shaders::far_field_merge,
           .slots = {{io::kTablesAt, tables()}, {io::kPiecesAt, raw_}},
           .size = {b.lines, strips},
           .layers = static_cast<int>(b.directions.size()),
           .push = push_words(io::Push{
               .transposed = b.plane->transposed, .merges = table, .line_stride = b.lines})});
    }
  }

  void add_sum(const Batch& b) {
    namespace io = far_field_sum_io;
    program_->add({.name = "sum",
                   .shader = shaders::far_field_sum,
                   .slots = {{io::kTablesAt, tables()},
                             {io::kRawAt, raw_},
                             {io::kSumsAt, line_sums_},
                             {io::kCountsAt, counts_}},
                   .size = {b.sum_rows, 1},
                   .push = push_words(io::Push{.rows = b.rows_table,
                                               .line_stride = b.lines,
                                               .sum_stride = tables_.sum_stride(b),
                                               .phases = tables_.line_phases(),
                                               .slope = slope()}),
                   .bytes = tables_.raw_bytes(b) + tables_.sum_bytes(b)});
  }

  // Lines, lattice, receivers and sums, which are read where an earlier batch has begun them.
  std::uint64_t evaluation_bytes(const Batch& b) const {
    const std::uint64_t lines = finite() ? tables_.raw_bytes(b) : tables_.sum_bytes(b);
    const int sums = channels() * (regions(*b.plane).filled ? 2 : 1);
    return lines + b.table_bytes + lattice_bytes(*b.plane) + frame_.visible_bytes(4 + sums);
  }

  void add_evaluation(const Batch& b) {
    namespace io = evaluation_io;
    const PlaneShape& p = *b.plane;
    PlaneRegions& r = regions(p);
    const int phases = tables_.phases();
    Pass pass{.name = "evaluate",
              .shader = finite() ? shaders::far_field_matter : shaders::far_field_evaluate,
              .constants = {{io::kFalloff, static_cast<int>(rho_.kind)},
                            {io::kChord, settings_.profile == SlabProfile::kAdaptiveChord},
                            {io::kSums, static_cast<int>(sums_)},
                            {io::kSide, far_field::group_side(settings_)},
                            {io::kTilePixels, tile()},
                            {io::kPhases, tables_.phases()},
                            {io::kLineStep, settings_.line_step},
                            {io::kSegments, settings_.segments},
                            {io::kJitter, settings_.jitter}},
              .slots = {{io::kTablesAt, tables()},
                        {io::kLatticeAt, r.lattice},
                        {io::kReceiversAt, r.receivers},
                        {io::kPlaneSumsAt, r.sums},
                        // A binding wants a region even where nothing is shared.
                        {io::kDenseAt, dense_ < 0 ? tables() : dense_}},
              .size = {(p.visible.width + phases - 1) / phases, p.visible.height},
              .layers = phases,
              .push = push_words(io::Push{.rho_radius = rho_.radius,
                                          .inverse_radius = rho_.inverse_radius,
                                          .entries_per_length = rho_.entries_per_length,
                                          .last_entry = rho_.last_entry,
                                          .rho_start = tables_.rho_start(),
                                          .transposed = p.transposed,
                                          .lattice_stride = p.stride,
                                          .margin = tables_.margin(),
                                          .directions = b.table,
                                          .direction_count = static_cast<int>(b.directions.size()),
                                          .sum_stride = finite() ? b.lines : tables_.sum_stride(b),
                                          .add = r.filled,
                                          .slope = slope()}),
              .bytes = evaluation_bytes(b)};
    if (finite()) {
      pass.slots.push_back({far_field_matter_io::kBackAt, r.back});
      pass.slots.push_back({far_field_matter_io::kLinesAt, raw_});
    } else {
      pass.slots.push_back({far_field_evaluate_io::kLineSumsAt, line_sums_});
      pass.slots.push_back({far_field_evaluate_io::kCountsAt, counts_});
    }
    program_->add(std::move(pass));
    r.filled = true;
  }

  // What passes that may be the last have in common (OBSCURA_TOTALS).
  Pass last_pass(const char* name, const Shader& shader, std::vector<BoundSlot> slots) const {
    namespace io = totals_io;
    slots.push_back({io::kNormalsAt, normals_});
    slots.push_back({io::kVisibilityResultAt, frame_.results.visibility});
    slots.push_back({io::kDirectionResultAt, frame_.results.directions});
    return {.name = name,
            .shader = shader,
            .constants = {{io::kSums, static_cast<int>(sums_)},
                          {io::kPaperCone, settings_.cone == ConeEstimate::kPaper},
                          {io::kUnsigned, frame_.shape.directions == Directions::kUnsigned}},
            .slots = std::move(slots),
            .size = frame_.visible()};
  }

  void add_collect() {
    const bool blur = settings_.jitter && settings_.blur, share = settings_.separable > 1;
    if (!blur && !share) {
      add_collect("write", -1);
      return;
    }
    const int totals = add_sums_region();
    add_collect("collect", totals);
    share ? add_gather(totals) : add_blur(totals);
  }

  // To the results, or to a region of totals.
  void add_collect(const char* name, int totals) {
    namespace io = far_field_collect_io;
    const bool to_image = totals < 0;
    Pass pass = last_pass(name, shaders::far_field_collect,
                          {{io::kStraightAt, regions_[0].sums},
                           {io::kTurnedAt, regions_[1].sums},
                           {io::kTotalsAt, to_image ? regions_[0].sums : totals}});
    pass.constants.emplace_back(io::kToImage, to_image);
    program_->add(std::move(pass));
  }

  void add_gather(int totals) {
    namespace io = far_field_gather_io;
    Pass pass =
        last_pass("gather", shaders::far_field_gather,
                  {{io::kDepthAt, depth_}, {io::kTotalsAt, totals}, {io::kDenseAt, dense_}});
    pass.constants.emplace_back(io::kSide, settings_.separable);
    pass.constants.emplace_back(io::kTilePixels, tile());
    program_->add(std::move(pass));
  }

  void add_blur(int totals) {
    namespace io = far_field_blur_io;
    program_->add(last_pass("blur", shaders::far_field_blur,
                            {{io::kDepthAt, depth_}, {io::kTotalsAt, totals}}));
  }

  const FarFieldSettings& settings_;
  const math::Rho& rho_;
  const Frame& frame_;
  const FarFieldTables tables_;
  const SliceSums sums_;
  Program* program_;
  PlaneRegions regions_[2];
  int depth_ = -1, back_ = -1, normals_ = -1;
  int dense_ = -1;
  int raw_ = -1, line_sums_ = -1, counts_ = -1;
};

}  // namespace

template <>
Status make_program(const FarFieldSettings& settings, const Frame& frame, Program* program) {
  FarFieldPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  const Demands demands{.method = "far-field", .normals = true, .directions = true};
  if (Status s = check(demands, frame.shape); !s.ok()) return s;
  if (Status s = check_back_depth(settings.occluder, frame.shape); !s.ok()) return s;
  FarFieldProgram(plan, frame, program).build();
  return {};
}

}  // namespace obscura::gpu

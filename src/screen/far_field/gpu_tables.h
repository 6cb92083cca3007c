#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_GPU_TABLES_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_GPU_TABLES_H_

#include <cstdint>
#include <vector>

#include "gpu/quads.h"
#include "obscura/frame_shape.h"
#include "screen/far_field/lines.h"
#include "screen/far_field/plan.h"

namespace obscura::gpu {

// The depth image in one orientation.
struct PlaneShape {
  PlaneShape(const FrameShape& shape, bool turned, int margin);

  bool transposed;
  int width, height, left, top;
  Extent visible;
  int stride;  // of the lattice
};

// Directions of one orientation that are scanned, summed and evaluated together. Tables are where
// their first quad is.
struct Batch {
  const PlaneShape* plane;
  std::vector<const far_field::Direction*> directions{};
  int table = 0;                   // of directions
  int rows_table = 0;              // of strips to sum
  int raw_rows = 0, sum_rows = 0;  // of strips, before sums and of sums
  int lines = 0, strips = 0;       // of the direction that has most
  std::vector<int> merges{};       // tables, a level each
  std::uint64_t table_bytes = 0;
};

// What shaders read of directions, strips, lines and samples, and in which batches.
class FarFieldTables {
 public:
  // The plan must outlive the tables.
  FarFieldTables(const FarFieldPlan& plan, const FrameShape& shape);
  FarFieldTables(const FarFieldTables&) = delete;
  FarFieldTables& operator=(const FarFieldTables&) = delete;

  int margin() const { return margin_; }  // of the lattice, beside each row
  int phases() const { return phases_; }
  int line_phases() const { return phases_ / settings_.line_step; }
  int rho_start() const { return rho_start_; }
  const PlaneShape& plane(bool transposed) const { return planes_[transposed]; }
  const std::vector<Batch>& batches() const { return batches_; }
  const std::vector<float>& words() const { return quads_.words(); }

  // Entries of a strip; phases are of equal length.
  int sum_stride(const Batch& b) const {
    return (b.lines + 1 + line_phases() - 1) / line_phases() * line_phases();
  }
  std::uint64_t raw_bytes(const Batch& b) const {
    return std::uint64_t{finite() ? 32u : 8u} * b.raw_rows * b.lines;
  }
  std::uint64_t sum_bytes(const Batch& b) const {
    return std::uint64_t{12} * b.sum_rows * sum_stride(b);
  }

 private:
  bool finite() const { return settings_.occluder.kind != OccluderKind::kSolid; }
  // Of a direction's strips, those that are there before sums; finite occluders have no sums.
  int raw_rows(const far_field::StripLevels& levels) const;
  int sum_rows(const far_field::StripLevels& levels) const { return finite() ? 0 : levels.all(); }

  void make_batches(const PlaneShape& plane);
  void make_tables(Batch* batch);
  int add_taps(const PlaneShape& p, const far_field::Direction& d,
               const far_field::Segment& segment);
  void add_reads(const PlaneShape& p, const far_field::Direction& d,
                 const far_field::StripLevels& levels, int direction_quad,
                 std::vector<int>* restarts);
  int add_intervals(const far_field::Direction& d, const far_field::Segment& segment,
                    const far_field::LineLayout& layout, const far_field::StripLevels& levels,
                    int row, int u, std::vector<int>* restarts);
  void add_merges(Batch* batch);
  void add_shifts(const far_field::LineLayout& layout, int height);

  const FarFieldSettings& settings_;
  const std::vector<far_field::Direction>& directions_;
  const int phases_, margin_;
  const PlaneShape planes_[2];
  std::vector<Batch> batches_;
  Quads quads_;
  int rho_start_ = 0;
};

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_GPU_TABLES_H_

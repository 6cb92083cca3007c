#include "apps/mpi/volume_ranks.h"

#include <cfloat>
#include <numeric>

#include "apps/mpi/shared_file.h"
#include "fmt/format.h"
#include "io/report/stopwatch.h"

namespace obscura::mpi {
namespace {

enum Tag { kDistanceFace, kRisingFace, kFallingFace };
constexpr int kMostRounds = 100;  // as in memory: 800 sweeps

// The slab of every rank.
Status split(const Ranks& ranks, const VolumeJob& job, int depth, std::vector<tools::Slab>* slabs) {
  const int cell =
      job.kind == tools::FieldsKind::kDistance ? 1 : field_cell(job.occlusion.transport);
  if (job.planes.empty()) {
    *slabs = tools::split_planes(depth, cell, ranks.count());
    if (static_cast<int>(slabs->size()) == ranks.count()) return {};
    return invalid_argument(
        fmt::format("{} ranks are too many for {} planes along z; start at most {}, a multiple of "
                    "{} planes each",
                    ranks.count(), depth, slabs->size(), cell));
  }
  const std::string given =
      fmt::format("--planes gives {} slabs with {} planes in all", job.planes.size(),
                  std::accumulate(job.planes.begin(), job.planes.end(), 0));
  int begin = 0;
  for (std::size_t i = 0; i < job.planes.size(); ++i) {
    const bool last = i + 1 == job.planes.size();
    if (job.planes[i] < 1 || (!last && job.planes[i] % cell != 0)) {
      return invalid_argument(fmt::format(
          "--planes: slab {} has {} planes; all slabs but the last must have a multiple of {}", i,
          job.planes[i], cell));
    }
    slabs->push_back({begin, begin + job.planes[i]});
    begin += job.planes[i];
  }
  if (static_cast<int>(slabs->size()) == ranks.count() && begin == depth) return {};
  return invalid_argument(fmt::format(
      "{}; it must give {} slabs, one for each rank, with {} planes", given, ranks.count(), depth));
}

class RankVolume {
 public:
  RankVolume(const Ranks& ranks, const tools::PlaneFile& file, const VolumeJob& job,
             const tools::Slab& slab, SharedFile& output)
      : ranks_(ranks), file_(file), job_(job), slab_(slab), output_(output) {
    run_.threads = job.threads;
  }

  Status read() {
    VolumeRange own;
    const Status mine = [&]() -> Status {
      if (Status s = samples_.read(file_, slab_); !s.ok()) return s;
      const auto n = file_.volume().size;
      distance_.resize(static_cast<std::size_t>(slab_.planes()) * n[0] * n[1]);
      return tools::slab_range(samples_, run_, &own);
    }();
    if (Status s = ranks_.agree(mine); !s.ok()) return s;
    // The same as add_to_range, by all ranks.
    float ends[2] = {own.finite > 0 ? -own.min : -FLT_MAX, own.finite > 0 ? own.max : -FLT_MAX};
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_FLOAT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &own.finite, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    if (own.finite == 0) return invalid_input("volume has no finite voxel; give one that has");
    own.min = -ends[0];
    own.max = ends[1];
    const Status s = check_isovalue(own, job_.distance);
    return s.ok() ? s : Status(s.code(), "--iso: " + s.message());
  }

  Status sweep_distances() {
    const auto n = file_.volume().size;
    const Status started = start_distance_block(samples_.image.view(), samples_.below,
                                                samples_.above, job_.distance, grid(), run_);
    samples_.image = {};
    if (Status s = ranks_.agree(started); !s.ok()) return s;
    Faces<float> faces(distance_face_size(n[0], n[1]));
    const int rounds = (job_.distance.sweeps + 7) / 8;
    const int most = job_.distance.converge ? kMostRounds : rounds;
    for (int round = 0; round < most; ++round) {
      int changed = 0;
      for (const bool rising : {true, false}) {
        bool fell = false;
        pass(faces, rising, kDistanceFace, [&](std::span<const float> up, std::span<float> down) {
          return sweep_distance_block(grid(), rising, up, down, &fell, run_);
        });
        changed |= int{fell};
      }
      if (!job_.distance.converge || round + 1 < rounds) continue;
      MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
      if (!changed) break;
    }
    return {};
  }

  Status sweep_light() {
    if (Status s = ranks_.agree(block_.start(grid(), job_.occlusion, run_)); !s.ok()) return s;
    distance_ = {};
    const std::size_t size = block_.face_size();
    Faces<std::int16_t> risen(size), fallen(size);
    // Light from below enters at rank 0 and light from above at the last rank, at the same time:
    // the lower half of the ranks begins with the one, the upper half with the other.
    const bool lower = 2 * ranks_.rank() < ranks_.count();
    for (const bool rising : {lower, !lower}) {
      pass(rising ? risen : fallen, rising, rising ? kRisingFace : kFallingFace,
           [&](std::span<const std::int16_t> up, std::span<std::int16_t> down) {
             return block_.sweep(rising, up, down, run_);
           });
    }
    return {};
  }

  Status write() {
    std::vector<float> values;
    tools::FieldGrid grid;
    const bool distances = job_.kind == tools::FieldsKind::kDistance;
    const int depth = file_.volume().size[2];
    grid = tools::field_grid(job_.kind, file_.volume(), block_.field());
    const int cell = distances ? 1 : field_cell(job_.occlusion.transport);
    grid.size[2] = (depth + cell - 1) / cell;
    Status mine;
    if (distances) {
      values = std::move(distance_);
    } else {
      mine = tools::field_values(job_.kind, block_.field(), run_, &values);
      block_ = {};
    }
    const std::vector<std::string> names = tools::field_names(job_.kind);
    const std::string header = tools::nrrd_field_header(grid, names);
    const std::int64_t plane =
        std::int64_t{4} * static_cast<std::int64_t>(names.size()) * grid.size[0] * grid.size[1];
    const auto begin = static_cast<std::int64_t>(header.size());
    if (mine.ok() && ranks_.first()) mine = output_.write(0, header.data(), begin);
    if (mine.ok()) {
      mine = output_.write(begin + slab_.begin / cell * plane, values.data(),
                           static_cast<std::int64_t>(values.size() * sizeof(float)));
    }
    return output_.finish(mine, begin + plane * grid.size[2]);
  }

 private:
  GridView<float> grid() {
    const auto n = file_.volume().size;
    const tools::Double3 h = file_.volume().spacing();
    return {
        distance_.data(), {n[0], n[1], slab_.planes()}, {float(h[0]), float(h[1]), float(h[2])}};
  }

  // Receives a face from the rank before, sweeps, sends one to the rank after. The others wait for
  // this rank, so that an error ends the job.
  template <class T, class Sweep>
  void pass(Faces<T>& faces, bool rising, Tag tag, const Sweep& sweep) {
    const int step = rising ? 1 : -1, from = ranks_.rank() - step, to = ranks_.rank() + step;
    std::span<const T> up;
    std::span<T> down;
    if (from >= 0 && from < ranks_.count()) up = faces.receive(from, tag);
    const bool goes_on = to >= 0 && to < ranks_.count();
    if (goes_on) down = faces.room();
    if (Status s = sweep(up, down); !s.ok()) ranks_.abort(s, output_.unfinished());
    if (goes_on) faces.send(to, tag);
  }

  const Ranks& ranks_;
  const tools::PlaneFile& file_;
  const VolumeJob& job_;
  const tools::Slab slab_;
  SharedFile& output_;
  RunOptions run_;
  tools::SlabSamples samples_;
  std::vector<float> distance_;
  OcclusionBlock block_;
};

}  // namespace

Status run_volume_job(const Ranks& ranks, const tools::PlaneFile& file, const VolumeJob& job,
                      VolumeTimes* times) {
  std::vector<tools::Slab> slabs;
  if (Status s = ranks.agree(split(ranks, job, file.volume().size[2], &slabs), false); !s.ok()) {
    return s;
  }
  SharedFile output(ranks, job.output);
  if (Status s = output.open(); !s.ok()) return s;
  RankVolume volume(ranks, file, job, slabs[static_cast<std::size_t>(ranks.rank())], output);
  auto timed = [](double* seconds, auto&& work) {
    const tools::Stopwatch watch;
    const Status s = work();
    *seconds = watch.seconds();
    return s;
  };
  try {
    if (Status s = timed(&times->read, [&] { return volume.read(); }); !s.ok()) return s;
    if (Status s = timed(&times->distance, [&] { return volume.sweep_distances(); }); !s.ok()) {
      return s;
    }
    if (job.kind != tools::FieldsKind::kDistance) {
      if (Status s = timed(&times->light, [&] { return volume.sweep_light(); }); !s.ok()) return s;
    }
    return timed(&times->write, [&] { return volume.write(); });
  } catch (const std::bad_alloc&) {
    ranks.abort({StatusCode::kOutOfMemory, "out of memory; start more ranks, or on more machines"},
                output.unfinished());
  }
}

}  // namespace obscura::mpi

#include "scene/volumes/load_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/images/files.h"
#include "io/volumes/nifti.h"
#include "io/volumes/nrrd.h"
#include "io/volumes/vdb.h"
#include "scene/volumes/histogram.h"
#include "scene/volumes/procedural.h"

namespace obscura::tools {
namespace {

enum class Format { kNone, kProcedural, kNifti, kNrrd, kVdb, kRaw };

Format format_of(const std::string& spec) {
  if (is_procedural_volume(spec)) return Format::kProcedural;
  const std::string ending = file_ending(spec);
  if (ending == ".nii") return Format::kNifti;
  if (ending == ".gz" && file_ending(spec.substr(0, spec.size() - 3)) == ".nii") {
    return Format::kNifti;
  }
  if (ending == ".nrrd" || ending == ".nhdr") return Format::kNrrd;
  if (ending == ".vdb") return Format::kVdb;
  if (ending == ".raw") return Format::kRaw;
  return Format::kNone;
}

Status read_raw(const std::string& path, const RawLayout& layout, VolumeImage* image) {
  PlaneFile file;
  if (Status s = file.open_raw(path, layout); !s.ok()) return s;
  return file.read(0, layout.size[2], image);
}

Status load(Format format, const std::string& spec, const std::optional<RawLayout>& raw,
            VolumeImage* image, int threads, const VolumeChoice& choice) {
  switch (format) {
    case Format::kProcedural:
      return make_procedural_volume(spec, image, threads);
    case Format::kNifti:
      return read_nifti(spec, choice.index.value_or(0), image);
    case Format::kNrrd:
      return read_nrrd(spec, image);
    case Format::kVdb:
      return read_vdb(spec, choice.grid, image);
    case Format::kRaw:
      if (raw) return read_raw(spec, *raw, image);
      return invalid_argument(
          fmt::format("{}: a raw file does not say its layout; give its size and type", spec));
    case Format::kNone:
      break;
  }
  return invalid_input(
      fmt::format("{}: is not a volume by its name; it must be volume:NAME or end "
                  "in .nii, .nii.gz, .nrrd, .nhdr, .vdb or .raw",
                  spec));
}

}  // namespace

bool is_volume(const std::string& spec) { return format_of(spec) != Format::kNone; }

Status load_volume(const std::string& spec, const std::optional<RawLayout>& raw, VolumeImage* image,
                   int threads, const VolumeChoice& choice) {
  const Format format = format_of(spec);
  if (raw && format != Format::kRaw) {
    return invalid_argument(
        fmt::format("{}: says its own layout; size and type are for .raw files", spec));
  }
  if (!choice.grid.empty() && format != Format::kVdb) {
    return invalid_argument(fmt::format("{}: has one grid; --grid is for .vdb files", spec));
  }
  if (choice.index && format != Format::kNifti) {
    return invalid_argument(
        fmt::format("{}: has one volume; --volume-index is for NIfTI files", spec));
  }
  try {
    return load(format, spec, raw, image, threads, choice);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("{}: does not fit in memory", spec)};
  }
}

Status describe_volume(const VolumeImage& image, Json* description) {
  Histogram h;
  if (Status s = make_histogram(image, &h); !s.ok()) return s;
  Json d;
  d["file"] = image.name;
  d["kind"] = "volume";
  d["format"] = image.format;
  d["size"] = image.size;
  d["type"] = image.stored_type;
  if (image.slope != 1 || image.intercept != 0) {
    d["slope"] = image.slope;
    d["intercept"] = image.intercept;
  }
  d["spacing"] = image.spacing();
  d["origin"] = image.origin;
  d["axes"] = image.axes;
  d["min"] = h.min;
  d["max"] = h.max;
  d["mean"] = h.mean;
  d["finite"] = h.finite;
  d["nan"] = h.nan;
  d["infinite"] = h.infinite;
  double threshold = 0;
  if (otsu_threshold(image, h, &threshold).ok()) d["otsu_threshold"] = threshold;
  if (image.isovalue) d["isovalue"] = *image.isovalue;
  if (image.solid) d["solid"] = enum_name(*image.solid);
  d["histogram"] = {{"first", h.first}, {"width", h.width}, {"counts", h.bins}};
  *description = std::move(d);
  return {};
}

Status describe_volume(const std::string& spec, const std::optional<RawLayout>& raw,
                       Json* description) {
  VolumeImage image;
  if (Status s = load_volume(spec, raw, &image); !s.ok()) return s;
  return describe_volume(image, description);
}

std::string volume_description_text(const Json& d) {
  auto triple = [&](const char* key, const char* between) {
    const Json::Array& v = d[key].elements();
    return fmt::format("{1:g}{0}{2:g}{0}{3:g}", between, v[0].number(), v[1].number(),
                       v[2].number());
  };
  std::string out = fmt::format("{}: {}, {} voxels of {}\n", d["file"].text(), d["format"].text(),
                                triple("size", "x"), d["type"].text());
  if (d.contains("slope")) {
    out +=
        fmt::format("  slope {:g}, intercept {:g}\n", d["slope"].number(), d["intercept"].number());
  }
  out += fmt::format("  spacing {}, origin {}\n", triple("spacing", " x "), triple("origin", ", "));
  for (int a = 0; a < 3; ++a) {
    const Json::Array& v = d["axes"].elements()[a].elements();
    out += fmt::format("  {} axis ({:g}, {:g}, {:g})\n", "xyz"[a], v[0].number(), v[1].number(),
                       v[2].number());
  }
  out += fmt::format("  values {:g} to {:g}, mean {:g}; NaN {}, infinite {}\n", d["min"].number(),
                     d["max"].number(), d["mean"].number(), std::int64_t(d["nan"].number()),
                     std::int64_t(d["infinite"].number()));
  if (d.contains("isovalue")) {
    out += fmt::format("  isovalue of its own {:g}, solid {}\n", d["isovalue"].number(),
                       d.contains("solid") ? d["solid"].text() : "above");
  }
  if (d.contains("otsu_threshold")) {
    out += fmt::format("  Otsu's threshold {:g}\n", d["otsu_threshold"].number());
  }
  // Sixteen lines whose length is the logarithm of the count.
  const Json& histogram = d["histogram"];
  const Json::Array& counts = histogram["counts"].elements();
  const double first = histogram["first"].number(), width = histogram["width"].number();
  const std::size_t lines = std::min<std::size_t>(16, counts.size());
  std::vector<std::int64_t> sums(lines);
  for (std::size_t i = 0; i < counts.size(); ++i)
    sums[i * lines / counts.size()] += std::int64_t(counts[i].number());
  const double most = double(*std::max_element(sums.begin(), sums.end()));
  for (std::size_t i = 0; i < lines; ++i) {
    const double from = first + width * std::ceil(double(i * counts.size()) / double(lines));
    const auto length =
        std::size_t(std::lround(40 * std::log1p(double(sums[i])) / std::log1p(most)));
    out += fmt::format("  from {:>11g} {:>11} {}\n", from, sums[i], std::string(length, '#'));
  }
  return out;
}

}  // namespace obscura::tools

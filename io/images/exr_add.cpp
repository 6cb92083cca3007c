#include <ImfChannelList.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfDeepTiledInputPart.h>
#include <ImfDeepTiledOutputPart.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "io/images/exr.h"
#include "io/images/exr_checked_file.h"
#include "io/images/exr_native.h"

namespace obscura::tools {
namespace {

struct NamedCompression {
  const char* name;
  Imf::Compression value;
  bool keeps_bits;
};
constexpr NamedCompression kCompressions[] = {
    {"none", Imf::NO_COMPRESSION, true},    {"rle", Imf::RLE_COMPRESSION, true},
    {"zips", Imf::ZIPS_COMPRESSION, true},  {"zip", Imf::ZIP_COMPRESSION, true},
    {"piz", Imf::PIZ_COMPRESSION, true},    {"pxr24", Imf::PXR24_COMPRESSION, false},
    {"b44", Imf::B44_COMPRESSION, false},   {"b44a", Imf::B44A_COMPRESSION, false},
    {"dwaa", Imf::DWAA_COMPRESSION, false}, {"dwab", Imf::DWAB_COMPRESSION, false},
};

bool keeps_bits(Imf::Compression compression) {
  for (const NamedCompression& c : kCompressions) {
    if (c.value == compression) return c.keeps_bits;
  }
  return false;
}

// Pixels of one channel over the part's data window.
struct Plane {
  std::string name;
  Imf::PixelType type;
  std::vector<char> pixels;
};

// What is done, and to which part of the file.
struct Plan {
  int part = 0;
  bool is_new = false;
  PixelWindow image;  // where it lies
};

std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

std::string channel_name(const ExrAddOptions& o, const std::string& name) {
  return o.layer.empty() ? name : o.layer + "." + name;
}

// The image's channel over the part's data window.
Plane plane_of(const Image::Channel& c, const ExrAddOptions& o, const PixelWindow& image,
               const PixelWindow& data) {
  const float outside = c.name == "visibility" ? 1 : 0;
  const auto count = static_cast<std::size_t>(data.width()) * data.height();
  std::vector<float> values(count, outside);
  const int x0 = std::max(image.min_x, data.min_x), x1 = std::min(image.max_x, data.max_x);
  for (int y = std::max(image.min_y, data.min_y);
       x0 <= x1 && y <= std::min(image.max_y, data.max_y); ++y) {
    const float* from = c.values.data() +
                        static_cast<std::size_t>(y - image.min_y) * image.width() + x0 -
                        image.min_x;
    std::copy_n(
        from, x1 - x0 + 1,
        values.data() + static_cast<std::size_t>(y - data.min_y) * data.width() + x0 - data.min_x);
  }
  Plane plane{channel_name(o, c.name), o.half ? Imf::HALF : Imf::FLOAT, {}};
  plane.pixels.resize(count * bytes_of(plane.type));
  if (o.half) {
    const std::vector<half> halves(values.begin(), values.end());
    std::memcpy(plane.pixels.data(), halves.data(), plane.pixels.size());
  } else {
    std::memcpy(plane.pixels.data(), values.data(), plane.pixels.size());
  }
  return plane;
}

Status choose_part(const std::string& path, const Imf::MultiPartInputFile& file,
                   const ExrAddOptions& o, Plan* plan) {
  if (o.part.empty()) return {};
  for (int p = 0; p < file.parts(); ++p) {
    const Imf::Header& header = file.header(p);
    if (header.hasName() && header.name() == o.part) {
      plan->part = p;
      return {};
    }
  }
  const char* end = o.part.data() + o.part.size();
  int number = 0;
  const auto [at, error] = std::from_chars(o.part.data(), end, number);
  if (error == std::errc() && at == end) {
    plan->part = number;
    if (number >= 0 && number < file.parts()) return {};
    return invalid_argument(fmt::format("{}: there is no part {}; it has {} of them, from 0", path,
                                        number, file.parts()));
  }
  plan->part = file.parts();
  plan->is_new = true;
  return {};
}

// Whether a part can be written again with more channels.
Status check_part(const std::string& path, const Imf::Header& header, const ExrAddOptions& o) {
  const char* what = nullptr;
  if (header.hasType() && Imf::isDeepData(header.type())) what = "is deep";
  if (header.hasTileDescription() && header.tileDescription().mode != Imf::ONE_LEVEL) {
    what = "has several levels";
  }
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) what = "is subsampled";
  }
  if (!what) return {};
  return invalid_input(fmt::format(
      "{}: the part {} {}, which takes no channels; give a new part's name in --into-part", path,
      o.part.empty() ? "0" : o.part, what));
}

Status check_names(const std::string& path, const Image& image, const ExrAddOptions& o,
                   const Imf::Header& header) {
  for (const Image::Channel& c : image.channels) {
    const std::string name = channel_name(o, c.name);
    if (o.replace || !header.channels().findChannel(name.c_str())) continue;
    return invalid_argument(
        fmt::format("{} has a channel {} already; give --replace, or another --layer", path, name));
  }
  return {};
}

void frame_of(std::vector<Plane>* planes, const PixelWindow& data, Imf::FrameBuffer* frame) {
  for (Plane& p : *planes) {
    const auto bytes = static_cast<std::ptrdiff_t>(bytes_of(p.type));
    frame->insert(p.name, Imf::Slice(p.type, origin_of(p.pixels.data(), data, bytes),
                                     static_cast<std::size_t>(bytes),
                                     static_cast<std::size_t>(bytes * data.width())));
  }
}

void copy_part(Imf::MultiPartInputFile& in, Imf::MultiPartOutputFile& out, int p) {
  const Imf::Header& header = in.header(p);
  const std::string type = header.hasType() ? header.type() : Imf::SCANLINEIMAGE;
  if (type == Imf::DEEPSCANLINE) {
    Imf::DeepScanLineInputPart from(in, p);
    Imf::DeepScanLineOutputPart(out, p).copyPixels(from);
  } else if (type == Imf::DEEPTILE) {
    Imf::DeepTiledInputPart from(in, p);
    Imf::DeepTiledOutputPart(out, p).copyPixels(from);
  } else if (header.hasTileDescription()) {
    Imf::TiledInputPart from(in, p);
    Imf::TiledOutputPart(out, p).copyPixels(from);
  } else {
    Imf::InputPart from(in, p);
    Imf::OutputPart(out, p).copyPixels(from);
  }
}

void write_part(Imf::MultiPartOutputFile& out, int p, std::vector<Plane>* planes,
                const PixelWindow& data) {
  Imf::FrameBuffer frame;
  frame_of(planes, data, &frame);
  if (out.header(p).hasTileDescription()) {
    Imf::TiledOutputPart part(out, p);
    part.setFrameBuffer(frame);
    part.writeTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
  } else {
    Imf::OutputPart part(out, p);
    part.setFrameBuffer(frame);
    part.writePixels(data.height());
  }
}

Status place_image(const std::string& path, const ExrHeader& h, const Image& image,
                   const ExrAddOptions& o, PixelWindow* window) {
  *window = h.display_window;
  if (o.guard_band) {
    const PixelWindow w = h.whole_window();
    const GuardBand& g = *o.guard_band;
    *window = {w.min_x + g.left, w.min_y + g.top, w.max_x - g.right, w.max_y - g.bottom};
  }
  if (window->width() == image.width && window->height() == image.height) return {};
  return invalid_input(fmt::format("{}: what it shows is {}x{}, the result {}x{}", path,
                                   window->width(), window->height(), image.width, image.height));
}

// The headers of the new file; that of the part with the channels last read from `planes`.
Status make_headers(Imf::MultiPartInputFile& in, const Plan& plan, const Image& image,
                    const ExrAddOptions& o, std::vector<Imf::Header>* headers) {
  for (int p = 0; p < in.parts(); ++p) {
    headers->push_back(in.header(p));
    Imf::Header& h = headers->back();
    if (!h.hasType()) h.setType(h.hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    // Parts have names as soon as there are several.
    if (plan.is_new && !h.hasName()) h.setName("main");
  }
  if (plan.is_new) {
    Imf::Header h((*headers)[0].displayWindow(), to_box(plan.image));
    h.setType(Imf::SCANLINEIMAGE);
    h.setName(o.part);
    h.pixelAspectRatio() = (*headers)[0].pixelAspectRatio();
    headers->push_back(h);
  }
  Imf::Header& h = (*headers)[static_cast<std::size_t>(plan.part)];
  if (plan.is_new || !keeps_bits(h.compression())) h.compression() = Imf::ZIP_COMPRESSION;
  if (!o.compression.empty()) {
    Imf::Compression compression;
    if (Status s = parse_exr_compression(o.compression, &compression); !s.ok()) return s;
    h.compression() = compression;
  }
  for (const Image::Channel& c : image.channels) {
    h.channels().insert(channel_name(o, c.name), Imf::Channel(o.half ? Imf::HALF : Imf::FLOAT));
  }
  if (!image.occluder.empty()) h.insert(kOccluderAttribute, Imf::StringAttribute(image.occluder));
  if (!o.made_by.empty()) h.insert(kMadeByAttribute, Imf::StringAttribute(o.made_by));
  return {};
}

}  // namespace

std::string exr_compressions() {
  std::string names;
  for (const NamedCompression& c : kCompressions)
    names += (names.empty() ? "" : ", ") + std::string(c.name);
  return names;
}

Status parse_exr_compression(const std::string& name, Imf::Compression* compression) {
  for (const NamedCompression& c : kCompressions) {
    if (name != c.name) continue;
    *compression = c.value;
    return {};
  }
  return invalid_argument(
      fmt::format("--compression is '{}'; it must be one of {}", name, exr_compressions()));
}

Status check_exr_compression(const std::string& name) {
  Imf::Compression compression;
  return name.empty() ? Status() : parse_exr_compression(name, &compression);
}

Status add_to_exr(const std::string& path, const std::string& target, const Image& image,
                  const ExrAddOptions& o) {
  return guard_exr(target, [&]() -> Status {
    ExrHeader header;
    std::unique_ptr<Imf::MultiPartInputFile> in;
    if (Status s = open_exr(target, &header, &in); !s.ok()) return s;
    Plan plan;
    if (Status s = choose_part(target, *in, o, &plan); !s.ok()) return s;
    if (plan.part != 0 && !plan.is_new) {
      if (Status s = open_exr(target, &header, &in, plan.part); !s.ok()) return s;
    }
    if (Status s = place_image(target, header, image, o, &plan.image); !s.ok()) return s;
    PixelWindow data = plan.image;
    std::vector<Plane> planes;
    if (!plan.is_new) {
      data = header.data_window;
      const Imf::Header& native = in->header(plan.part);
      if (Status s = check_part(target, native, o); !s.ok()) return s;
      if (Status s = check_names(target, image, o, native); !s.ok()) return s;
      const auto count = static_cast<std::size_t>(data.width()) * data.height();
      for (auto it = native.channels().begin(); it != native.channels().end(); ++it) {
        const Imf::PixelType type = it.channel().type;
        planes.push_back({it.name(), type, std::vector<char>(count * bytes_of(type))});
      }
      Imf::FrameBuffer frame;
      frame_of(&planes, data, &frame);
      Imf::InputPart part(*in, plan.part);
      part.setFrameBuffer(frame);
      part.readPixels(data.min_y, data.max_y);
    }
    for (const Image::Channel& c : image.channels) {
      Plane plane = plane_of(c, o, plan.image, data);
      std::erase_if(planes, [&](const Plane& p) { return p.name == plane.name; });
      planes.push_back(std::move(plane));
    }
    std::vector<Imf::Header> headers;
    if (Status s = make_headers(*in, plan, image, o, &headers); !s.ok()) return s;

    CheckedFile stream(path);
    std::string reason;
    if (stream.error() == 0) {
      try {
        Imf::MultiPartOutputFile out(stream, headers.data(), static_cast<int>(headers.size()),
                                     plan.is_new);  // which takes over what all parts share
        for (int p = 0; p < static_cast<int>(headers.size()); ++p) {
          if (p == plan.part) {
            write_part(out, p, &planes, data);
          } else {
            copy_part(*in, out, p);
          }
        }
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception& e) {
        reason = e.what();
      }
    }
    // The errno is the plainer reason, where there is one.
    if (const int error = stream.close(); error != 0) reason = std::strerror(error);
    if (!reason.empty()) {
      return {StatusCode::kInternal, fmt::format("cannot write {}: {}", path, reason)};
    }
    return {};
  });
}

}  // namespace obscura::tools

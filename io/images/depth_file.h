#ifndef OBSCURA_IO_IMAGES_DEPTH_FILE_H_
#define OBSCURA_IO_IMAGES_DEPTH_FILE_H_

#include <array>
#include <optional>
#include <string>

#include "io/images/background.h"
#include "io/images/depth_input.h"
#include "io/images/exr.h"
#include "io/images/view_size.h"

namespace obscura::tools {

enum class NormalSpace {
  kAuto,   // eye space, checked against the depth and mended or refused
  kView,   // eye space: believed
  kWorld,  // turned by worldToCamera
};

// What a file's depth values are: DepthKind, and kinds that become linear depth on reading.
enum class FileDepthKind {
  kLinear,
  kDistance,
  kNdc,
  kNdcReversed,
  kInverse,      // 1 / depth, 0 for background (Nuke)
  kLogarithmic,  // log2(1 + depth) / log2(1 + far) (three.js)
};

// A pinhole camera in pixels: focal lengths, and the principal point from the corner of the visible
// part; centres of pixels are at half-integers (OpenCV counts from a centre: add 0.5).
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

}  // namespace obscura::tools

namespace obscura {
template <>
struct EnumNames<tools::NormalSpace> {
  static constexpr const char* names[] = {"auto", "view", "world"};
};
template <>
struct EnumNames<tools::FileDepthKind> {
  static constexpr const char* names[] = {"linear",       "distance", "ndc",
                                          "ndc-reversed", "inverse",  "logarithmic"};
};
template <>
struct SettingText<std::optional<tools::Intrinsics>> {
  static constexpr const char* form = "FX,FY,CX,CY in pixels";
  static bool parse(std::string_view text, std::optional<tools::Intrinsics>* value);
  static std::string write(const std::optional<tools::Intrinsics>& value);
};
template <>
struct SettingText<std::optional<tools::GuardBandSpec>> {
  static constexpr const char* form = SettingText<tools::GuardBandSpec>::form;
  static bool parse(std::string_view text, std::optional<tools::GuardBandSpec>* value);
  static std::string write(const std::optional<tools::GuardBandSpec>& value);
};
template <>
struct SettingText<std::string> {
  static constexpr const char* form = "text";
  static bool parse(std::string_view text, std::string* value) {
    *value = text;
    return !text.empty();
  }
  static std::string write(const std::string& value) { return value; }
};
}  // namespace obscura

namespace obscura::tools {

// What a depth image does not say by itself.
struct DepthFileOptions {
  std::string depth_channel{};
  std::string back_depth_channel{};
  std::string normals = "auto";
  NormalSpace normal_space = NormalSpace::kAuto;
  bool normals_packed = false;
  std::string world_to_camera{};
  std::string part{};
  std::optional<double> fov_y{}, ortho_height{}, focal_length{}, sensor_height{};
  std::optional<Intrinsics> intrinsics{};
  std::string projection{};
  FileDepthKind depth_kind = FileDepthKind::kLinear;
  std::optional<double> depth_scale{};
  ValueList background{}, invalid{};
  std::optional<double> near{}, far{};
  std::optional<GuardBandSpec> guard_band{};
  // As many depth layers as an occluder asks for are read where the EXR file has them: layerK.Z and
  // layerK.ZBack with K from 1. Not a user's setting.
  int layers = 0;
  // The 16 numbers of `projection`, where they do not come from a file of their own. Not a user's
  // setting.
  std::optional<std::array<double, 16>> projection_matrix{};
};
template <FieldsOf<DepthFileOptions> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.depth_channel, Field{"depth_channel",
                           "",
                           {},
                           "EXR channel that holds depth; by default Z, depth.Z, Depth.V, "
                           "ViewLayer.Depth.Z or a similar name."});
  v(s.back_depth_channel, Field{"back_depth_channel",
                                "",
                                {},
                                "EXR channel of the back depth, where the first object ends; by "
                                "default ZBack, if there is one."});
  v(s.normals, Field{"normals",
                     "",
                     {},
                     "auto (the file's, or from depth), depth (from depth), none (methods that "
                     "can, work without), or the prefix of three EXR channels such as N or "
                     "ViewLayer.Normal."});
  v(s.normal_space, Field{"normal_space",
                          "",
                          {},
                          "Space of the file's normals: auto checks them against depth, view "
                          "believes them, world turns them by the EXR attribute worldToCamera or "
                          "world-to-camera."});
  v(s.normals_packed,
    Field{"normals_packed", "", {}, "The file's normals are stored as n/2 + 1/2, in [0, 1]."});
  v(s.world_to_camera, Field{"world_to_camera",
                             "",
                             {},
                             "File with the 16 (or 3x3) numbers of the matrix from world to camera "
                             "space, row-major, for column vectors: the file's normals are in "
                             "world space."});
  v(s.part, Field{"part",
                  "",
                  {},
                  "Part of an EXR file, by name or number from 0; by default the first that has "
                  "depth."});
  v(s.fov_y, Field{"fov_y", "degrees", {}, "Vertical field of view of the visible part."});
  v(s.ortho_height, Field{"ortho_height",
                          "world units",
                          {},
                          "Height of the visible part of an "
                          "orthographic view."});
  v(s.focal_length, Field{"focal_length",
                          "as sensor-height",
                          {},
                          "Focal length of the lens; with "
                          "sensor-height, in place of fov-y."});
  v(s.sensor_height, Field{"sensor_height",
                           "as focal-length",
                           {},
                           "Height of the sensor's visible "
                           "part."});
  v(s.intrinsics, Field{"intrinsics",
                        "",
                        {},
                        "Focal lengths and principal point of the visible part, from its upper "
                        "left corner."});
  v(s.projection, Field{"projection",
                        "",
                        {},
                        "File with the 16 numbers of the visible part's "
                        "projection matrix, row-major, for column vectors, depth from 0 to 1."});
  v(s.depth_kind, Field{"depth_kind", "", {}, "What the depth values are."});
  v(s.depth_scale, Field{"depth_scale",
                         "world units",
                         {},
                         "One unit of the stored depth: 0.001 for millimetres. A PNG stores whole "
                         "numbers up to 65535, which is background."});
  v(s.near, Field{"near", "world units", {}, "Near plane of NDC depth; depth of black in a PNG."});
  v(s.far, Field{"far", "world units", {}, "Far plane: this depth and beyond is background."});
  v(s.background, Field{"background",
                        "",
                        {},
                        "Stored values that mean no surface, beside +inf, NaN, 1e9 and beyond, and "
                        "(for linear depth) 0 and a far plane that the image was cleared to; none: "
                        "not even these two. May be repeated."});
  v(s.invalid, Field{"invalid",
                     "",
                     {},
                     "Stored values that mean a hole: as background it neither receives nor "
                     "occludes. May be repeated."});
  v(s.guard_band, Field{"guard_band",
                        "",
                        {},
                        "Pixels around the visible part; by default an EXR file's data window "
                        "outside its display window."});
}

// Reads depth, back depth, normals and camera from an EXR, PFM or 16-bit PNG file. The camera comes
// from the options or from the EXR attributes worldToCamera and worldToNDC.
Status load_depth_input(const std::string& path, const DepthFileOptions& options,
                        DepthInput* input);

// Chooses a part of an EXR file: the one named, or the first in which depth is found.
Status choose_exr_part(const std::string& path, const std::vector<ExrHeader>& parts,
                       const DepthFileOptions& options, int* part);

// What of an EXR file would be used; parts of load_depth_input and of `obscura info`.
struct ExrChannelChoice {
  std::string depth, back_depth;  // "" where there is none
  std::string normals[3];
};
Status choose_exr_channels(const std::string& path, const ExrHeader& header,
                           const DepthFileOptions& options, ExrChannelChoice* choice);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_DEPTH_FILE_H_

#ifndef OBSCURA_IO_IMAGES_DEPTH_FILE_H_
#define OBSCURA_IO_IMAGES_DEPTH_FILE_H_

#include <array>
#include <optional>
#include <string>

#include "io/images/depth_input.h"
#include "io/images/exr.h"
#include "io/images/view_size.h"

namespace obscura::tools {

enum class NormalSpace { kView, kWorld };

}  // namespace obscura::tools

namespace obscura {
template <>
struct EnumNames<tools::NormalSpace> {
  static constexpr const char* names[] = {"view", "world"};
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
  NormalSpace normal_space = NormalSpace::kView;
  std::optional<double> fov_y{}, ortho_height{}, focal_length{}, sensor_height{};
  std::string projection{};
  DepthKind depth_kind = DepthKind::kLinear;
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
                     "auto (the file's, or from depth), none, or the prefix of "
                     "three EXR channels such as N or ViewLayer.Normal."});
  v(s.normal_space, Field{"normal_space",
                          "",
                          {},
                          "Space of the file's normals; world needs the "
                          "EXR attribute worldToCamera."});
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
  v(s.projection, Field{"projection",
                        "",
                        {},
                        "File with the 16 numbers of the visible part's "
                        "projection matrix, row-major, for column vectors, depth from 0 to 1."});
  v(s.depth_kind, Field{"depth_kind", "", {}, "What the depth values are."});
  v(s.near, Field{"near", "world units", {}, "Near plane of NDC depth; depth of black in a PNG."});
  v(s.far, Field{"far", "world units", {}, "Far plane: this depth and beyond is background."});
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

// What of an EXR file would be used; parts of load_depth_input and of `obscura info`.
struct ExrChannelChoice {
  std::string depth, back_depth;  // "" where there is none
  std::string normals[3];
};
Status choose_exr_channels(const std::string& path, const ExrHeader& header,
                           const DepthFileOptions& options, ExrChannelChoice* choice);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_DEPTH_FILE_H_

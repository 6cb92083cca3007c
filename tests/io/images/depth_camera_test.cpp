#include "io/images/depth_camera.h"

#include <cmath>

#include "io/images/files.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

// A camera off the axis, of 60 by 40 pixels: 2 n/w = 1.2, 2 n/h = 1.8, shifted by 0.1 and -0.2.
constexpr const char* kRight = "1.2 0 0.1 0  0 1.8 -0.2 0  0 0 -1.001001 -0.1001001  0 0 -1 0";
constexpr const char* kTransposed = "1.2 0 0 0  0 1.8 0 0  0.1 -0.2 -1.001001 -1  0 0 -0.1001001 0";
constexpr const char* kLeftHanded = "1.2 0 -0.1 0  0 1.8 0.2 0  0 0 1.001001 -0.1001001  0 0 1 0";
constexpr const char* kParallel = "0.5 0 0 0.1  0 0.7 0 0.2  0 0 -0.01 0  0 0 0 1";
constexpr const char* kParallelTransposed = "0.5 0 0 0  0 0.7 0 0  0 0 -0.01 0  0.1 0.2 0 1";
constexpr const char* kNoDepth = "1.2 0 0 0  0 1.8 0 0  0 0 0 0  0 0 -1 0";

class DepthCamera : public FilesTest {
 protected:
  Status load(const char* matrix, DepthInput* input, FileDepthKind kind = FileDepthKind::kLinear) {
    Image image(60, 40);
    for (float& v : image.add("Y")) v = 0.5f;
    EXPECT_TRUE(write_image(path("d.pfm"), image).ok());
    write("p.txt", matrix);
    DepthFileOptions o;
    o.projection = path("p.txt");
    o.depth_kind = kind;
    return load_depth_input(path("d.pfm"), o, input);
  }
};

TEST_F(DepthCamera, TransposedMatricesAreNamed) {
  DepthInput input;
  for (const char* matrix : {kRight, kParallel}) {
    const Status s = load(matrix, &input);
    EXPECT_TRUE(s.ok()) << s.message();
    EXPECT_TRUE(input.notes.empty());
  }
  for (const char* matrix : {kTransposed, kParallelTransposed}) {
    const Status s = load(matrix, &input);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find("looks transposed"), std::string::npos) << s.message();
  }
}

TEST_F(DepthCamera, LeftHandedOnesAreTurned) {
  DepthInput right, left;
  ASSERT_TRUE(load(kRight, &right).ok());
  const Status s = load(kLeftHanded, &left);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(right.camera, left.camera);
  ASSERT_EQ(left.notes.size(), 1u);
  EXPECT_NE(left.notes[0].find("left-handed"), std::string::npos);
  ASSERT_TRUE(load(kLeftHanded, &left, FileDepthKind::kNdc).ok());
  ASSERT_TRUE(load(kRight, &right, FileDepthKind::kNdc).ok());
  EXPECT_EQ(right.near_plane, left.near_plane);
  EXPECT_EQ(right.far_plane, left.far_plane);
}

TEST_F(DepthCamera, AMatrixWithoutDepthIsRefusedWhereDepthNeedsIt) {
  DepthInput input;
  EXPECT_TRUE(load(kNoDepth, &input).ok());
  const Status s = load(kNoDepth, &input, FileDepthKind::kNdc);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("maps no depth"), std::string::npos) << s.message();
  for (const char* bad : {"inf 0 0 0 0 1 0 0 0 0 -1 -1 0 0 -1 0", "1 2 3", ""}) {
    EXPECT_EQ(load(bad, &input).code(), StatusCode::kInvalidInput) << bad;
  }
}

TEST_F(DepthCamera, IntrinsicsCountFromTheVisibleCorner) {
  Image image(60, 40);
  for (float& v : image.add("Y")) v = 2;
  ASSERT_TRUE(write_image(path("d.pfm"), image).ok());
  DepthFileOptions o;
  o.intrinsics = Intrinsics{50, 40, 22, 17};
  o.guard_band = GuardBandSpec{false, 4, 3};
  DepthInput input;
  ASSERT_TRUE(load_depth_input(path("d.pfm"), o, &input).ok());
  EXPECT_FLOAT_EQ(input.camera.scale_x, 1 / 50.0f);
  EXPECT_FLOAT_EQ(input.camera.scale_y, 1 / 40.0f);
  EXPECT_FLOAT_EQ(input.camera.center_u, 26);
  EXPECT_FLOAT_EQ(input.camera.center_v, 20);
  o.fov_y = 50;
  EXPECT_EQ(load_depth_input(path("d.pfm"), o, &input).code(), StatusCode::kInvalidArgument);
  o.fov_y = {};
  o.intrinsics->fx = 0;
  EXPECT_EQ(load_depth_input(path("d.pfm"), o, &input).code(), StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace obscura::tools

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "paths.h"
#include "scene/rays/solids.h"
#include "scene/scenes/load_scene.h"
#include "scene/scenes/scene.h"

namespace obscura::tools {
namespace {

// Everything that a scene calls closed must be what find_solids() calls a solid, faces outward.
TEST(Scenes, ClosedPartsAreWatertightAndFaceOutward) {
  for (const SceneKind& kind : scene_catalogue()) {
    Scene scene;
    ASSERT_TRUE(kind.build({}, 1, &scene).ok()) << kind.name;
    const Mesh& mesh = scene.mesh;
    std::size_t covered = 0;
    for (const Mesh::Part& part : mesh.parts) {
      ASSERT_EQ(part.first, covered) << kind.name;
      covered += part.count;
      if (!part.closed) continue;
      Mesh alone;
      alone.positions = mesh.positions;
      alone.triangles.assign(mesh.triangles.begin() + std::ptrdiff_t(part.first),
                             mesh.triangles.begin() + std::ptrdiff_t(part.first + part.count));
      // Positions that are not used only cost time.
      std::vector<Mesh::Point> used;
      for (Mesh::Triangle& t : alone.triangles) {
        for (std::uint32_t* index : {&t.a, &t.b, &t.c}) {
          used.push_back(mesh.positions[*index]);
          *index = std::uint32_t(used.size() - 1);
        }
      }
      alone.positions = std::move(used);
      ASSERT_GT(signed_volume(alone, 0, alone.triangles.size()), 0) << kind.name << covered;
      find_solids(&alone);
      for (const Mesh::Part& p : alone.parts) {
        ASSERT_TRUE(p.closed) << kind.name << " part that ends at triangle " << covered;
      }
    }
    EXPECT_EQ(covered, mesh.triangles.size()) << kind.name;
    EXPECT_GT(mesh.scene_size, 0) << kind.name;
  }
}

TEST(Scenes, SameSeedSameBitsForAnyNumberOfThreads) {
  for (const char* spec : {"scene:hall?size=96x54&layers=3", "scene:meadow?size=96x54&layers=3"}) {
    Rendering one, two;
    ASSERT_TRUE(load_scene(spec, {}, *make_executor(1), &one).ok());
    ASSERT_TRUE(load_scene(spec, {}, *make_executor(2), &two).ok());
    EXPECT_EQ(one.gbuffer.depth, two.gbuffer.depth) << spec;
    EXPECT_EQ(one.gbuffer.normal_x, two.gbuffer.normal_x) << spec;
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(one.gbuffer.layers[k].front, two.gbuffer.layers[k].front) << spec;
      EXPECT_EQ(one.gbuffer.layers[k].back, two.gbuffer.layers[k].back) << spec;
    }
  }
  DepthInput first, other;
  ASSERT_TRUE(load_scene("scene:meadow?size=64x36&seed=1", &first).ok());
  ASSERT_TRUE(load_scene("scene:meadow?size=64x36&seed=2", &other).ok());
  EXPECT_NE(first.depth, other.depth);
}

TEST(Scenes, OptionsReachTheView) {
  DepthInput input;
  ASSERT_TRUE(load_scene("scene:corner?size=101x57&guard-band=7,9&fov-y=40", &input).ok());
  EXPECT_EQ(input.width, 101 + 14);
  EXPECT_EQ(input.height, 57 + 18);
  EXPECT_EQ(input.guard_band, GuardBand::symmetric(7, 9));
  EXPECT_NEAR(input.camera.scale_y, 2 * std::tan(20 * 3.14159265358979 / 180) / 57, 1e-7);
  ASSERT_TRUE(
      load_scene("scene:plane?guard-band=25%&ortho-height=2&tilt-x=0&back-depth=1", &input).ok());
  EXPECT_EQ(input.guard_band, GuardBand::symmetric(160, 90));
  EXPECT_TRUE(input.camera.orthographic);
  EXPECT_FLOAT_EQ(input.depth[0], 3);
  EXPECT_FLOAT_EQ(input.back_depth[0], 4);
}

TEST(Scenes, MistakesAreNamed) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"scene:hal", "there is no scene \"hal\"; the scenes are plane, groove"},
      {"scene:", "there is no scene \"\""},
      {"hall", "is not a scene"},
      {"scene:hall?colums=3", "there is no key \"colums\"; hall has bays"},
      {"scene:hall?bays", "\"bays\" is not of the form key=value"},
      {"scene:hall?bays=3&bays=4", "bays is given twice"},
      {"scene:hall?bays=0", "bays"},
      {"scene:hall?size=0x10", "size"},
      {"scene:hall?size=640", "size"},
      {"scene:hall?guard-band=-1", "guard-band"},
      {"scene:hall?guard-band=3,4,5", "guard-band"},
      {"scene:hall?seed=x", "seed"},
      {"scene:hall?eye=1,2", "eye"},
      {"scene:hall?eye=nan,0,0", "eye"},
      {"scene:hall?fov-y=180", "fov-y is 180 degrees; it must be in [0.01, 179.9]"},
      {"scene:hall?fov-y=50&ortho-height=3", "fov-y and ortho-height are both given"},
      {"scene:hall?layers=65", "layers"},
      {"scene:hall?sheet-thickness=-1", "sheet-thickness"},
      {"scene:hall?eye=0,1,0&look-at=0,1,0", "they must differ"},
      {"scene:hall?eye=0,1,0&look-at=0,0,0", "along up"},
      {"scene:hall?size=65535x65535", "size with guard band"},
      {"scene:hall?size=32000x32000", "at most 2^28 pixels"},
      {"scene:hall?eye=1e30,0,0", "within 1e12"},
      {"scene:hall?ortho-height=1e30", "ortho-height is 1e+30"},
      {"scene:bump?radius=1e300", "radius"},
      {"scene:meadow?blades=1e9", "blades"},
      {"scene:sphere-over-plane?eye=0,1.5,0.5", "inside a solid"},
      {"scene:cornell?eye=0.1,-0.05,0", "inside a solid"},
  };
  for (const auto& [spec, message] : mistakes) {
    DepthInput input;
    input.name = "untouched";
    const Status status = load_scene(spec, &input);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << spec;
    EXPECT_NE(status.message().find(message), std::string::npos)
        << spec << ": " << status.message();
    EXPECT_EQ(status.message().find('\n'), std::string::npos) << spec;
    EXPECT_EQ(input.name, "untouched");
  }
}

TEST(Scenes, PageHoldsTheTables) {
  std::ifstream file(OBSCURA_SOURCE_DIR "/docs/scenes.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(scene_tables()), std::string::npos) << "docs/scenes.md should hold:\n\n"
                                                                << scene_tables();
}

}  // namespace
}  // namespace obscura::tools

// Inputs of kinds that went wrong in tools like this one, and what a correct program makes of them.
#include <cstdlib>

#include "tests/command/run_command.h"

namespace obscura {
namespace {

class Faults : public CommandTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not here";
  }

  // Runs a command whose inputs are `@NAME`, and gives the mean visibility that it reports.
  double mean(std::string line, const std::string& said = "") {
    for (std::size_t at; (at = line.find('@')) != std::string::npos;) {
      line.replace(at, 1, kFolder + "/");
    }
    const CommandResult r = run(line + " --json - -o o.pfm");
    EXPECT_EQ(r.code, 0) << line << "\n" << r.err;
    EXPECT_NE(r.err.find(said), std::string::npos) << line << "\n" << r.err;
    const std::size_t at = r.out.find("\"mean visibility\"");
    const std::size_t value = r.out.find("\"value\":", at);
    if (at == std::string::npos || value == std::string::npos) return -1;
    return std::atof(r.out.c_str() + value + 8);
  }
  // With matter as the figures that are right were found with.
  double solid(const std::string& input, const std::string& more, const std::string& said = "") {
    return mean("ao @" + input + " --occluder solid " + more, said);
  }

  const std::string kFolder = OBSCURA_SOURCE_DIR "/../shared/data/faults";
};

TEST_F(Faults, BlenderSaysNothingAt1e10AndHasWorldNormals) {
  EXPECT_NEAR(solid("blender_multilayer.exr", "--fov-y 32.2688", "1e+09 and beyond"), 0.932, 0.003);
  EXPECT_NEAR(solid("blender_ortho_z.exr", "--ortho-height 4.5", "1e+09 and beyond"), 0.914, 0.003);
}

TEST_F(Faults, NormalsAreCheckedAndMended) {
  const double right = solid("normals_view.exr", "--fov-y 50");
  EXPECT_NEAR(right, 0.973, 0.003);
  EXPECT_NEAR(solid("normals_world_zup.exr", "--fov-y 50", "normals"), right, 0.003);
  EXPECT_NEAR(solid("normals_away.exr", "--fov-y 50", "normals"), right, 0.003);
}

TEST_F(Faults, ADistantBackgroundIsBackground) {
  const std::string rays = "--method ray-traced --rays 16 --fov-y 50";
  EXPECT_EQ(solid("sphere_bg_b1e10.exr", rays, "1e+09 and beyond"),
            solid("sphere_bg_inf.exr", rays));
  const double box = solid("orthobox_bg_inf.exr", "--ortho-height 4");
  EXPECT_NEAR(box, 0.971, 0.003);
  EXPECT_EQ(solid("orthobox_bg_b1e10.exr", "--ortho-height 4", "1e+09 and beyond"), box);
}

TEST_F(Faults, MillimetresWithHolesAtZero) {
  EXPECT_NEAR(solid("mm_hole0.png", "--fov-y 50 --depth-scale 0.001"), 0.974, 0.003);
}

TEST_F(Faults, MeshesFarFromTheOrigin) {
  const std::string view = "--fov-y 25 --size 80x45 --method geometric --rays 64 ";
  const double right = mean("ao @base.obj --eye 3,3,5 --look-at 0,.3,0 " + view);
  EXPECT_NEAR(right, 0.940, 0.005);
  EXPECT_NEAR(
      mean("ao @off10000.obj --eye 10003,10003,10005 --look-at 10000,10000.3,10000 " + view), right,
      0.003);
  EXPECT_NEAR(
      mean("ao @utm.obj --eye 448126.25,3,5411992.75 --look-at 448123.25,.3,5411987.75 " + view),
      right, 0.003);
}

TEST_F(Faults, QuantizedPositions) {
  const std::string view =
      " --occluder solid --eye 3,3,5 --look-at 0,.3,0 --fov-y 25 --size 160x90";
  const double right = mean("ao @plain.glb" + view);
  EXPECT_NEAR(right, 0.911, 0.003);
  EXPECT_NEAR(mean("ao @gltfpack_quantized.glb" + view), right, 0.001);
}

TEST_F(Faults, ContainersOfSeveralThings) {
  EXPECT_NEAR(solid("multipart.exr", "--fov-y 50", "part"), 0.976, 0.003);
  // Spellings and axes of one volume: the same picture, byte for byte.
  std::string right;
  for (const char* name : {"ball3d.nrrd", "ball4d_list1.nrrd"}) {
    const CommandResult r =
        run("volume '" + kFolder + "/" + name + "' --size 96x96 --light ao -q -o v.pfm");
    ASSERT_EQ(r.code, 0) << name << r.err;
    const std::string bytes = read_file(path("v.pfm"));
    if (right.empty()) right = bytes;
    EXPECT_TRUE(bytes == right) << name;
    std::filesystem::remove(path("v.pfm"));
  }
  // The same ball in files of slices, and as 1000 + 100 times its values in whole numbers.
  auto said = [&](const char* name) { return run("info '" + kFolder + "/" + name + "'").out; };
  EXPECT_NE(said("slices.nhdr").find("values -6.99038 to 5.13397, mean -1.67235;"),
            std::string::npos);
  const std::string whole = said("ball_ushortint.nrrd");
  EXPECT_NE(whole.find("16x16x16 voxels of u16"), std::string::npos) << whole;
  EXPECT_NE(whole.find("values 300 to 1513, mean 832.229;"), std::string::npos) << whole;
}

TEST_F(Faults, Projections) {
  EXPECT_NEAR(solid("sphere_bg_inf.exr", "--projection '" + kFolder + "/proj.txt'"), 0.974, 0.003);
  expect_failure("ao '" + kFolder + "/sphere_bg_inf.exr' --projection '" + kFolder +
                     "/proj_transposed.txt' -o p.pfm",
                 3, "looks transposed");
}

TEST_F(Faults, EqualInfinitiesAreEqual) {
  const std::string file = "'" + kFolder + "/sphere_bg_inf.exr'";
  const CommandResult r = run("compare " + file + " " + file + " --channel Z");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("e_A 0.000 %  e_<5% 100.00 %"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace obscura

#include <sys/stat.h>

#include "tests/command/run_command.h"

// Names of files on the command line: what may be an output, and what an input.
namespace obscura {
namespace {

std::string pfm(int width, int height, float depth = 3) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1\n";
  for (int i = 0; i < width * height; ++i) {
    bytes.append(reinterpret_cast<const char*>(&depth), sizeof(depth));
  }
  return bytes;
}

class PathsTest : public CommandTest {
 protected:
  PathsTest() { write("a.pfm", pfm(16, 16)); }
};

TEST_F(PathsTest, AnOutputIsNoInput) {
  const std::string before = read_file(path("a.pfm"));
  std::filesystem::create_symlink("a.pfm", path("link.pfm"));
  expect_failure("ao a.pfm --fov-y 60 -o a.pfm", 2, "--output a.pfm is INPUT too");
  expect_failure("ao a.pfm --fov-y 60 -o ./link.pfm", 2, "is INPUT too");
  expect_failure("ao link.pfm --fov-y 60 -o ../" +
                     std::filesystem::path(folder_).filename().string() + "/a.pfm",
                 2, "is INPUT too");
  expect_failure("ao a.pfm --fov-y 60 -o b.pfm --json a.pfm", 2, "--json a.pfm is INPUT too");
  expect_failure("ao a.pfm --projection p.txt -o b.pfm --json p.txt", 2, "is --projection too");
  expect_failure("light a.pfm --fov-y 60 --environment e.exr -o e.exr", 2, "is --environment too");
  expect_failure("compare a.pfm link.pfm --error-image a.pfm", 2, "is A too");
  expect_failure("ao f.####.exr --frames 1-2 -o ./f.####.exr", 2, "is INPUT too");
  EXPECT_EQ(read_file(path("a.pfm")), before);
}

TEST_F(PathsTest, AnOutputIsNoOtherOutput) {
  expect_failure("ao a.pfm --fov-y 60 -o b.exr --json b.exr", 2,
                 "--output b.exr and --json are the same file");
  expect_failure("volume volume:gyroid?size=16 --fields ./f.nrrd -o v.png --json f.nrrd", 2,
                 "the same file");
  expect_failure("terrain a.pfm --cell-size 1 -o t.png --picture t.png", 2, "the same file");
  EXPECT_FALSE(std::filesystem::exists(path("b.exr")));
  // What holds nothing may be named twice.
  expect_success("ao a.pfm --fov-y 60 -q -o b.exr --json /dev/null");
  EXPECT_EQ(run("info --simd --json -").code, 0);
}

TEST_F(PathsTest, ChannelsAreKeptInTheFileItself) {
  expect_success("gbuffer scene:cornell?size=16x16 -q -o g.exr");
  expect_success("ao g.exr -q --keep-channels -o g.exr");
  expect_success("ao g.exr -q --into g.exr --layer again");
  expect_failure("ao g.exr -o g.exr", 2, "is INPUT too");
  expect_failure("ao g.exr --keep-channels -o b.exr --json g.exr", 2, "is INPUT too");
  const CommandResult info = run("info g.exr");
  for (const char* channel : {"Z", "visibility", "again.visibility"}) {
    EXPECT_NE(info.out.find(channel), std::string::npos) << info.out;
  }
}

// The scene would take minutes.
TEST_F(PathsTest, OutputsThatCannotBeWrittenAreRefusedBeforeTheWork) {
  const std::string long_work = "ao scene:hall?size=8000x8000 --method ray-traced --rays 16384 ";
  std::filesystem::create_directory(path("d.exr"));
  expect_failure(long_work + "-o none/a.exr", 1, "there is no folder none");
  expect_failure(long_work + "-o d.exr", 1, "it is a folder");
  expect_failure(long_work + "-o a.pfm/a.exr", 1, "there is no folder a.pfm");
  expect_failure(long_work + "-o a.exr --json none/a.json", 1, "--json none/a.json: there is no");
  expect_failure(long_work + "-o " + std::string(252, 'n') + ".exr", 1, "name too long");
}

TEST_F(PathsTest, DevicesAreNotRead) {
  for (const char* ending :
       {"exr", "pfm", "png", "nrrd", "nii", "vdb", "raw", "ply", "obj", "glb"}) {
    const std::string name = std::string("zero.") + ending;
    std::filesystem::create_symlink("/dev/zero", path(name));
    const std::string e = ending;
    const bool volume = e == "nrrd" || e == "nii" || e == "vdb" || e == "raw";
    const CommandResult r = run(std::string(volume ? "volume " : "ao ") + name + " -o out.exr" +
                                (e == "raw" ? " --raw-size 9x9x9" : ""));
    if (r.err.find("this build has no OpenVDB") != r.err.npos) continue;
    EXPECT_EQ(r.code, 3) << name << r.err;
    EXPECT_TRUE(r.err.find("device") != r.err.npos || r.err.find("not a file") != r.err.npos)
        << r.err;
  }
}

TEST_F(PathsTest, APipeIsReadOnce) {
  const std::string whole = "ao a.pfm --fov-y 60 -q -o whole.pfm";
  expect_success(whole);
  ASSERT_EQ(mkfifo(path("p.pfm").c_str(), 0600), 0);
  const CommandResult r =
      run("ao p.pfm --fov-y 60 -q -o piped.pfm", "(cat a.pfm >p.pfm &); timeout 20");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(read_file(path("whole.pfm")), read_file(path("piped.pfm")));
  ASSERT_EQ(mkfifo(path("p.exr").c_str(), 0600), 0);
  expect_failure("ao p.exr -o o.exr", 3, "it is a pipe", "timeout 20");
}

}  // namespace
}  // namespace obscura

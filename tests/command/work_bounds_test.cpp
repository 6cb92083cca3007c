#include <sys/resource.h>

#include <random>

#include "obscura/methods.h"
#include "tests/command/run_command.h"

// What a command takes is bounded by its input, not by its square.
namespace obscura {
namespace {

class WorkBoundsTest : public CommandTest {
 protected:
  // A depth image whose surface is rough everywhere.
  void write_rough(const std::string& name, int width, int height) {
    std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1\n";
    std::mt19937 random(width);
    for (int i = 0; i < width * height; ++i) {
      const float depth = 3 + static_cast<float>(random() % 1000) / 1000;
      bytes.append(reinterpret_cast<const char*>(&depth), sizeof(depth));
    }
    write(name, bytes);
  }
};

// Sanitizers take memory and time for themselves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMeasures = false;
#else
constexpr bool kMeasures = true;
#endif
constexpr std::size_t kLongestLine = 301;  // with the end of line

// Of all commands that have ended: their processor time, as other work on the machine does not
// count, and the most memory that one has held.
double processor_seconds() {
  rusage u{};
  getrusage(RUSAGE_CHILDREN, &u);
  auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(u.ru_utime) + seconds(u.ru_stime);
}
double peak_bytes() {
  rusage u{};
  getrusage(RUSAGE_CHILDREN, &u);
  return 1024.0 * double(u.ru_maxrss);
}

// Far below what a square needs.
const std::string kLimits = address_limit() + "timeout 60";

TEST_F(WorkBoundsTest, LongImages) {
  write_rough("wide.pfm", 65535, 1);
  write_rough("high.pfm", 1, 65535);
  write_rough("dot.pfm", 1, 1);
  for (const std::string_view method : method_names()) {
    for (const char* name : {"wide.pfm", "high.pfm", "dot.pfm"}) {
      std::string line = std::string("ao ") + name + " --fov-y 60 -q -o a.pfm --method ";
      line += method;
      if (method == "ray-traced") line += " --rays 4";
      const CommandResult r = run(line, kLimits);
      EXPECT_EQ(r.code, 0) << line << "\n" << r.err;
      EXPECT_GT(std::filesystem::file_size(path("a.pfm")), 4u);
      std::filesystem::remove(path("a.pfm"));
    }
  }
}

// Files that crashed, hung or filled the memory: each does what it should, or ends in one line.
TEST_F(WorkBoundsTest, FilesThatAttacked) {
  const std::string folder = std::string(OBSCURA_SOURCE_DIR) + "/../shared/data/faults/attack";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string(), file = entry.path().string();
    std::string line = "ao '" + file + "' --fov-y 60 -q -o a.exr";
    if (ending == ".vdb" || ending == ".nrrd") line = "volume '" + file + "' -q -o a.exr";
    if (ending == ".raw") {
      line = "volume '" + file +
             "' --raw-size 10x10x10 --raw-spacing 1,1,200 --iso 60 --light shadow:0,0,-1 "
             "--size 8x8 -q -o a.exr";
    }
    const double before = processor_seconds();
    const CommandResult r = run(line, kLimits);
    EXPECT_TRUE(r.code == 0 || r.code == 2 || r.code == 3) << line << "\n" << r.code << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), r.code != 0) << r.err;
    EXPECT_LE(r.err.size(), kLongestLine) << r.err;
    for (const char c : r.err) EXPECT_TRUE((c >= ' ' && c < 127) || c == '\n') << r.err;
    if (!kMeasures) continue;
    EXPECT_LE(processor_seconds() - before, 5) << line;
    EXPECT_LE(peak_bytes(), 5e8 + static_cast<double>(entry.file_size())) << line;
  }
}

// OpenVDB warns of a format of the future, on standard output, and reads it all the same.
TEST_F(WorkBoundsTest, VolumesOfALaterOpenVdb) {
  const CommandResult made =
      run("volume volume:gyroid?size=12 --size 8x8 -q --fields v.vdb -o a.exr");
  if (made.code == 2) GTEST_SKIP() << made.err;
  ASSERT_EQ(made.code, 0) << made.err;
  std::string bytes = read_file(path("v.vdb"));
  constexpr std::size_t kHighByteOfVersion = 11;
  bytes[kHighByteOfVersion] = 16;
  write("later.vdb", bytes);
  const CommandResult r = run("info later.vdb", kLimits);
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("OpenVDB, "), std::string::npos) << r.out;
}

// Mutants of a kind: what a header promises is not there, or unfolds without end.
TEST_F(WorkBoundsTest, HeadersThatPromiseTooMuch) {
  auto refused = [&](const std::string& name, const std::string& bytes) {
    write(name, bytes);
    const CommandResult r = run("ao " + name + " --fov-y 60 -q -o a.exr", kLimits);
    EXPECT_EQ(r.code, 3) << name << "\n" << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << name << r.err;
  };
  refused("deep.gltf", std::string(200000, '['));
  std::string nest = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
  for (int i = 1; i <= 60000; ++i) nest += "{\"children\":[" + std::to_string(i) + "]},";
  refused("nest.gltf", nest + "{}]}");
  refused("huge.pfm", "Pf\n60000 60000\n-1\n" + std::string(100, 'x'));
  refused("huge.ply",
          "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
          "property float y\nproperty float z\nend_header\n0 0 0\n");
  refused("word.obj", "v 1 2 3\nf 1 2 999999999999\n");
}

}  // namespace
}  // namespace obscura

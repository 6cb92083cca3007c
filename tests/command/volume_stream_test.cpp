// obscura volume --memory: slabs from file to file give the bytes of the whole volume in memory.
#include <cmath>

#include "fmt/format.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

const std::string kInput = "volume g.raw --raw-size 150x90x63 --iso 120 ";

class VolumeStream : public CommandTest {
 protected:
  VolumeStream() {
    std::string samples;
    for (int z = 0; z < 63; ++z) {
      for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 150; ++x) {
          const double a = 0.2 * x, b = 0.2 * y, c = 0.2 * z;
          const double f =
              std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a);
          samples += char(std::lround(std::fmin(std::fmax(80 * (f + 1.5), 0), 255)));
        }
      }
    }
    write("g.raw", samples);
  }
  // Slabs that the run says it had.
  int expect_same(const std::string& options, const std::string& memory) {
    expect_success(kInput + options + " --fields whole.nrrd -q");
    const CommandResult r =
        run(kInput + options + " --fields slabs.nrrd --threads 2 --memory " + memory);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(read_file(path("whole.nrrd")) == read_file(path("slabs.nrrd"))) << options;
    EXPECT_FALSE(std::filesystem::exists(path("slabs.nrrd.work")));
    const std::size_t at = r.out.find(" voxels in ");
    return at == std::string::npos ? 0 : std::stoi(r.out.substr(at + 11));
  }
};

TEST_F(VolumeStream, SlabsGiveTheBytesOfTheWhole) {
  EXPECT_GE(expect_same("", "82M"), 2);
  EXPECT_EQ(expect_same("--fields-of scalar --transport fast", "1G"), 1);
  EXPECT_GE(expect_same("--fields-of scalar --transport accurate --light translucent:0.3", "83M"),
            2);
  EXPECT_GE(expect_same("--fields-of octants --transport paper --sweeps 16", "85M"), 2);
  EXPECT_GE(expect_same("--fields-of distance --converge", "82M"), 1);
}

// A limit on the size of files, in blocks of 512 bytes, stands for a full disk. The distances take
// 3.40 MB, the field 3.46 MB: the run ends in its first pass or in its last. Then, without the
// limit, the same command begins anew or goes on.
TEST_F(VolumeStream, GoesOnAfterAFullDisk) {
  const std::string stream = kInput + "--fields slabs.nrrd --memory 82M --threads 2";
  expect_success(kInput + "--fields whole.nrrd -q");
  for (const int blocks : {2000, 6700}) {
    write("slabs.nrrd", "older");
    expect_failure(stream, 1, "cannot write", fmt::format("ulimit -f {};", blocks));
    EXPECT_EQ(read_file(path("slabs.nrrd")), "older");
    const bool begun = std::filesystem::exists(path("slabs.nrrd.work"));
    EXPECT_EQ(begun, blocks > 2000);
    const CommandResult r = run(stream);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out.find("goes on with a run that was ended") != std::string::npos, begun);
    EXPECT_TRUE(read_file(path("whole.nrrd")) == read_file(path("slabs.nrrd"))) << blocks;
    EXPECT_FALSE(std::filesystem::exists(path("slabs.nrrd.work")));
  }
}

TEST_F(VolumeStream, PartsOfAnotherRunAreNotTaken) {
  const std::string stream = kInput + "--fields slabs.nrrd --memory 82M --threads 2 ";
  expect_failure(stream, 1, "cannot write", "ulimit -f 6700;");
  expect_failure(stream + "--sweeps 16", 2, "slabs.nrrd.work holds parts of another run");
}

TEST_F(VolumeStream, MistakesAreNamed) {
  const std::string stream = kInput + "--fields slabs.nrrd ";
  expect_failure(stream + "--memory 80M --threads 1", 2,
                 "--memory: 80 MB do not hold a slab of planes; give at least 81M");
  expect_failure(stream + "--memory some", 2, "--memory is 'some'; it must be a size such as");
  expect_failure(kInput + "-o x.png --memory 1G", 2, "pictures need the volume in memory");
  expect_failure(stream + "--light shadow:1,1,1 --memory 1G --fields-of distance", 2,
                 "--memory has the lights ao and translucent:ALPHA, not shadow:1,1,1");
  expect_failure(stream + "--precision f32 --memory 1G", 2, "--precision u8 only");
  expect_failure("volume g.raw --raw-size 150x90x63 --fields slabs.nrrd --memory 1G", 2,
                 "--memory needs --iso");
  expect_failure("volume volume:cup --iso 0 --fields slabs.nrrd --memory 1G", 2,
                 "planes can be read one by one of .raw, .nrrd and .nhdr files");
  expect_failure("volume g.raw --raw-size 150x90x63 --iso 999 --fields slabs.nrrd --memory 1G", 2,
                 "--iso: isovalue is 999, which does not cut the volume; its values go from");
  EXPECT_FALSE(std::filesystem::exists(path("slabs.nrrd.work")));
}

}  // namespace
}  // namespace obscura

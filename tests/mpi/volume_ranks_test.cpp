// obscura-mpi: any number of ranks writes the bytes that obscura volume writes.
#include <cmath>

#include "fmt/format.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

// Two planes are a slab's least, so that eight ranks have one to four pairs of planes here.
constexpr int kSize[3] = {45, 37, 31};
const std::string kInput = "volume g.raw --raw-size 45x37x31 --iso 120 ";

const std::string kOut = kInput + "--fields out.nrrd ";

std::string gyroid() {
  std::string samples;
  for (int z = 0; z < kSize[2]; ++z) {
    for (int y = 0; y < kSize[1]; ++y) {
      for (int x = 0; x < kSize[0]; ++x) {
        const double a = 0.2 * x, b = 0.2 * y, c = 0.2 * z;
        const double f =
            std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a);
        samples += char(std::lround(std::fmin(std::fmax(80 * (f + 1.5), 0), 255)));
      }
    }
  }
  return samples;
}

class MpiVolume : public CommandTest {
 protected:
  MpiVolume() { write("g.raw", gyroid()); }

  // `ranks`: mpirun's arguments up to the program, and what comes behind the first program's.
  CommandResult mpirun(const std::string& ranks, const std::string& arguments,
                       const std::string& more = "") {
    const std::string line = fmt::format(
        "cd '{}'; mpirun --allow-run-as-root --oversubscribe {} '{}' {} {} >stdout.txt "
        "2>stderr.txt </dev/null",
        folder_, ranks, OBSCURA_MPI_COMMAND, arguments, more);
    const int status = std::system(line.c_str());
    CommandResult result;
    if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
    result.out = read_file(path("stdout.txt"));
    result.err = read_file(path("stderr.txt"));
    return result;
  }
  // The bytes of a field by so many ranks, or of the command.
  std::string field(int ranks, const std::string& options) {
    std::filesystem::remove(path("field.nrrd"));
    const std::string arguments = kInput + options + " --fields field.nrrd -q";
    const CommandResult r =
        ranks == 0 ? run(arguments) : mpirun(fmt::format("-n {}", ranks), arguments);
    EXPECT_EQ(r.code, 0) << arguments << r.err;
    return read_file(path("field.nrrd"));
  }
  void expect_same(int ranks, const std::string& options, const std::string& more = "") {
    EXPECT_TRUE(field(0, options) == field(ranks, options + more))
        << ranks << " ranks, " << options << more;
  }
  // Ends with `code` and a line that holds `part`, and leaves no file but those that were there.
  void expect_mpi_failure(const std::string& ranks, const std::string& arguments, int code,
                          const std::string& part, const std::string& more = "") {
    write("out.nrrd", "older");
    const CommandResult r = mpirun(ranks, arguments, more);
    EXPECT_EQ(r.code, code) << arguments << "\n" << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << arguments << "\n" << r.err;
    EXPECT_EQ(read_file(path("out.nrrd")), "older");
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
    }
  }
};

TEST_F(MpiVolume, BytesDoNotDependOnTheRanks) {
  for (const int ranks : {1, 2, 4, 8}) expect_same(ranks, "");
  expect_same(2, "--fields-of distance --converge");
}

TEST_F(MpiVolume, NorOnTheTransportAndTheSplit) {
  for (const char* transport : {"paper", "fast", "balanced", "accurate"}) {
    expect_same(4, fmt::format("--transport {} --fields-of scalar", transport));
  }
  expect_same(3, "--light translucent:0.4", " --planes 2,22,7 --threads 2");
  expect_same(4, "--fields-of distance", " --planes 1,1,28,1");
}

TEST_F(MpiVolume, RanksAndSlabsThatDoNotFitAreRefused) {
  expect_mpi_failure("-n 20", kOut, 2,
                     "20 ranks are too many for 31 planes along z; start at most 16");
  expect_mpi_failure("-n 2", kOut + "--planes 15,16", 2,
                     "slab 0 has 15 planes; all slabs but the last must have a multiple of 2");
  expect_mpi_failure("-n 2", kOut + "--planes 10,10", 2,
                     "--planes gives 2 slabs with 20 planes in all; it must give 2 slabs, one for "
                     "each rank, with 31 planes");
  expect_mpi_failure("-n 2", kOut + "--light lit", 2, "it must be ao or translucent:ALPHA");
}

TEST_F(MpiVolume, RanksThatWereStartedOtherwiseAreRefused) {
  expect_mpi_failure("-n 1", kOut, 2, "rank 1: has other arguments than rank 0",
                     fmt::format(": -n 1 '{}' {} --sweeps 16", OBSCURA_MPI_COMMAND, kOut));
}

TEST_F(MpiVolume, BadFilesEndTheJobInOneLine) {
  expect_mpi_failure("-n 2", "volume g.raw --raw-size 45x37x30 --iso 120 --fields out.nrrd", 3,
                     "g.raw: has 51615 bytes; 45x37x30 voxels of u8 need exactly 49950");
  expect_mpi_failure("-n 2", kInput + "--fields nowhere/out.nrrd", 1,
                     "cannot write nowhere/out.nrrd: No such file or directory");
  expect_mpi_failure("-n 2", "volume g.raw --raw-size 45x37x31 --iso 300 --fields out.nrrd", 2,
                     "--iso: isovalue is 300, which does not cut the volume");
  expect_mpi_failure("-n 2", "volume g.vdb --iso 1 --fields out.nrrd", 2,
                     "planes can be read one by one of .raw, .nrrd and .nhdr files");
}

// A file system of 100 kB, for a field of 220 kB; who is not root cannot make one.
TEST_F(MpiVolume, AFullDiskLeavesTheOlderFile) {
  const std::string small = path("small");
  std::filesystem::create_directory(small);
  if (std::system(("mount -t tmpfs -o size=100k tmpfs " + small + " 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "cannot mount a small file system here";
  }
  write("small/out.nrrd", "older");
  const CommandResult r = mpirun("-n 2", kInput + "--fields small/out.nrrd");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("cannot write small/out.nrrd"), std::string::npos) << r.err;
  EXPECT_EQ(read_file(path("small/out.nrrd")), "older");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(small), {}), 1);
  EXPECT_EQ(std::system(("umount " + small).c_str()), 0);
}

// The second rank may not have more memory than the program itself takes.
TEST_F(MpiVolume, ARankWithoutMemoryEndsTheJob) {
  const std::string size = "--raw-size 2000x2000x40 --iso 120 --fields out.nrrd";
  std::filesystem::resize_file(path("g.raw"), 160000000);  // longer by zeros
  const std::string arguments = "volume g.raw " + size;
  expect_mpi_failure(
      "-n 1", arguments, 1, "rank 1: g.raw: 84000000 voxels do not fit in memory",
      fmt::format(": -n 1 sh -c 'ulimit -d 60000; exec {} {}'", OBSCURA_MPI_COMMAND, arguments));
}

}  // namespace
}  // namespace obscura

// Sequences as a user or a farm runs them.
#include <set>
#include <vector>

#include "io/images/exr.h"
#include "io/images/files.h"
#include "nlohmann/json.hpp"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

class SequenceTest : public CommandTest {
 protected:
  // depth.0001.exr and so on, each of another scene.
  void make_shot(int frames, const std::string& size = "64x36") {
    for (int k = 1; k <= frames; ++k) {
      const std::string name = "depth.000" + std::to_string(k) + ".exr";
      expect_success("gbuffer 'scene:meadow?size=" + size + "&seed=" + std::to_string(k) +
                     "' -q -o " + name);
    }
  }
  // The bytes of a sequence's files.
  std::vector<std::string> files(const std::string& name, int frames) {
    std::vector<std::string> list;
    for (int k = 1; k <= frames; ++k) {
      list.push_back(read_file(path(name + ".000" + std::to_string(k) + ".exr")));
    }
    return list;
  }
  void remove(const std::string& name) { std::filesystem::remove(path(name)); }

  const std::string ao_ = "ao 'depth.####.exr' --method line --radius 1 -q ";
};

TEST_F(SequenceTest, FramesAreThoseOfSingleRuns) {
  make_shot(3);
  expect_success(ao_ + "--frames 1-3 -o 'a.%04d.exr'");
  for (int k = 1; k <= 3; ++k) {
    const std::string n = "000" + std::to_string(k) + ".exr";
    expect_success("ao depth." + n + " --method line --radius 1 -q -o one." + n);
    tools::Image a, b;
    ASSERT_TRUE(tools::read_image(path("a." + n), &a).ok());
    ASSERT_TRUE(tools::read_image(path("one." + n), &b).ok());
    EXPECT_EQ(a.channels[0].values, b.channels[0].values) << k;
  }
  expect_success("ao 'depth.$F4.exr' --method line --radius 1 -q --frames 1-3x2 -o 'b.#.exr'");
  EXPECT_TRUE(std::filesystem::exists(path("b.1.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("b.2.exr")));
  EXPECT_TRUE(std::filesystem::exists(path("b.3.exr")));
}

TEST_F(SequenceTest, ShardsAndTwoWorkersGiveTheSameFiles) {
  make_shot(5);
  expect_success(ao_ + "--frames 1-5 -o 'a.####.exr'");
  const auto whole = files("a", 5);
  EXPECT_EQ(std::set<std::string>(whole.begin(), whole.end()).size(), 5u);
  for (int shards : {3, 5}) {
    for (int k = 1; k <= 5; ++k) remove("a.000" + std::to_string(k) + ".exr");
    for (int k = 1; k <= shards; ++k) {
      expect_success(ao_ + "--frames 1-5 -o 'a.####.exr' --shard " + std::to_string(k) + "/" +
                     std::to_string(shards));
    }
    EXPECT_EQ(files("a", 5), whole) << shards;
  }
  for (int k = 1; k <= 5; ++k) remove("a.000" + std::to_string(k) + ".exr");
  const std::string line = ao_ + "--frames 1-5 --skip-existing -o 'a.####.exr'";
  const CommandResult both = run(line, "'" OBSCURA_COMMAND "' " + line + " & trap wait EXIT; ");
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(files("a", 5), whole);
}

// The line of docs/farms.md.
TEST_F(SequenceTest, GnuParallelRunsTheShards) {
  if (std::system("parallel --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no GNU parallel";
  make_shot(5);
  expect_success(ao_ + "--frames 1-5 -o 'a.####.exr'");
  const std::string line = "cd '" + folder_ + "' && parallel -j 2 '" OBSCURA_COMMAND "' " +
                           "ao depth.####.exr --method line --radius 1 --frames 1-5 -o b.####.exr "
                           "--shard {}/3 --threads 1 -q ::: 1 2 3 >/dev/null 2>&1 </dev/null";
  ASSERT_EQ(std::system(line.c_str()), 0);
  EXPECT_EQ(files("b", 5), files("a", 5));
}

TEST_F(SequenceTest, SkipExistingMakesWhatIsMissingOrWasMadeOtherwise) {
  make_shot(4);
  expect_success(ao_ + "--frames 1-4 -o 'a.####.exr'");
  const auto whole = files("a", 4);
  remove("a.0002.exr");
  const std::string skipping = ao_ + "--frames 1-4 --skip-existing -o 'a.####.exr' ";
  const CommandResult resumed = run(skipping + "--json report.json");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  const auto rows = nlohmann::json::parse(read_file(path("report.json")))["rows"];
  EXPECT_EQ(rows[0]["metric"], "frames written");
  EXPECT_EQ(rows[0]["value"], 1);
  EXPECT_EQ(rows[1]["value"], 3);  // skipped
  EXPECT_EQ(files("a", 4), whole);

  // A file that was cut off, one of other settings and one of no sequence are made again.
  write("a.0001.exr", whole[0].substr(0, whole[0].size() / 2).substr(0, 200));
  expect_success("ao depth.0003.exr --method line --radius 1 -q -o a.0003.exr");
  const CommandResult again = run(skipping);
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("a.0003.exr was made by no sequence; made again"), again.err.npos);
  EXPECT_EQ(files("a", 4), whole);
  const CommandResult other = run(skipping + "--samples 3");
  EXPECT_EQ(other.code, 0);
  EXPECT_NE(other.err.find("a.0004.exr was made otherwise"), other.err.npos) << other.err;
  EXPECT_NE(files("a", 4)[3], whole[3]);
}

TEST_F(SequenceTest, FailuresAreListedOrEndTheSequence) {
  make_shot(4);
  write("depth.0002.exr", "no image");
  expect_failure(ao_ + "--frames 1-4 -o 'a.####.exr'", 3, "depth.0002.exr");
  EXPECT_TRUE(std::filesystem::exists(path("a.0001.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("a.0003.exr")));
  const CommandResult r = run(ao_ + "--frames 1-6 --continue-on-error -o 'a.####.exr'");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("obscura: frame 2: "), r.err.npos) << r.err;
  EXPECT_NE(r.err.find("obscura: 3 of 6 frames failed: 2, 5, 6\n"), r.err.npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(path("a.0004.exr")));
}

// `ulimit -f` stands for a disk that is full: a frame that does not fit leaves those before it.
TEST_F(SequenceTest, AFullDiskLeavesWholeFrames) {
  make_shot(2, "32x18");
  expect_success("gbuffer 'scene:meadow?size=512x288&seed=3' -q -o depth.0003.exr");
  const CommandResult r = run(ao_ + "--frames 1-3 -o 'a.####.exr'", "ulimit -f 40;");
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_NE(r.err.find("a.0003.exr"), r.err.npos) << r.err;
  tools::Image image;
  for (const char* name : {"a.0001.exr", "a.0002.exr"}) {
    EXPECT_TRUE(tools::read_image(path(name), &image).ok());
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().filename().string().find("a.0003"), std::string::npos);
  }
}

// Killed at any time and run again: every frame is there once, whole, with the same bits.
TEST_F(SequenceTest, KilledAndRunAgain) {
  make_shot(5);
  expect_success(ao_ + "--frames 1-5 -o 'a.####.exr'");
  const auto whole = files("a", 5);
  for (int k = 1; k <= 5; ++k) remove("a.000" + std::to_string(k) + ".exr");
  const std::string line = ao_ + "--frames 1-5 --skip-existing -o 'a.####.exr'";
  for (int tenths = 1; tenths <= 6; ++tenths) {
    run(line, "timeout -s KILL 0." + std::to_string(tenths));
    for (const std::string& bytes : files("a", 5)) {
      if (!bytes.empty()) {
        EXPECT_NE(std::find(whole.begin(), whole.end(), bytes), whole.end());
      }
    }
  }
  expect_success(line);
  EXPECT_EQ(files("a", 5), whole);
}

// The same depth seen by a wider camera has other normals and another visibility.
TEST_F(SequenceTest, CamerasComeFromAFileOfMatrices) {
  const std::vector<float> depth = {4, 4, 4, 4, 4, 3, 3, 4, 4, 3, 3, 4, 4, 4, 4, 4};
  std::string pfm = "Pf\n4 4\n-1.0\n";
  pfm.append(reinterpret_cast<const char*>(depth.data()), depth.size() * 4);
  for (const char* name : {"d.1.pfm", "d.2.pfm", "d.3.pfm"}) write(name, pfm);
  auto projection = [](double scale) {
    return "[" + std::to_string(scale) + ",0,0,0, 0," + std::to_string(scale) +
           ",0,0, 0,0,-1,-0.1, 0,0,-1,0]";
  };
  write("one.txt", projection(1));
  write("three.txt", projection(3));
  write("cameras.json", "{\"1\":" + projection(1) + ", \"2\":" + projection(3) + "}");
  const std::string line = " --method line --radius 1 -q ";
  expect_success("ao 'd.#.pfm'" + line + "--frames 1-2 --cameras cameras.json -o 'a.#.pfm'");
  expect_success("ao d.1.pfm" + line + "--projection one.txt -o one.pfm");
  expect_success("ao d.1.pfm" + line + "--projection three.txt -o three.pfm");
  EXPECT_EQ(read_file(path("a.1.pfm")), read_file(path("one.pfm")));
  EXPECT_EQ(read_file(path("a.2.pfm")), read_file(path("three.pfm")));
  EXPECT_NE(read_file(path("a.1.pfm")), read_file(path("a.2.pfm")));
  expect_failure("ao 'd.#.pfm'" + line + "--frames 1-3 --cameras cameras.json -o 'b.#.pfm'", 3,
                 "cameras.json: it has no matrix for frame 3");
  EXPECT_FALSE(std::filesystem::exists(path("b.1.pfm")));
}

TEST_F(SequenceTest, LightOverFrames) {
  make_shot(2);
  const std::string light =
      " --environment sky --method line --radius 1 --cones mean "
      "--technique ambient-occlusion -q ";
  expect_success("light 'depth.####.exr'" + light + "--frames 1-2 -o 'a.####.exr'");
  expect_success("light depth.0002.exr" + light + "-o one.exr");
  tools::Image a, b;
  ASSERT_TRUE(tools::read_image(path("a.0002.exr"), &a).ok());
  ASSERT_TRUE(tools::read_image(path("one.exr"), &b).ok());
  for (int k = 0; k < 3; ++k) EXPECT_EQ(a.channels[k].values, b.channels[k].values);
}

TEST_F(SequenceTest, ScenesOverTheirKeysBecomeGBuffers) {
  const std::string line = "gbuffer 'scene:meadow?size=64x36&seed=##' -q --frames 1-3 ";
  expect_success(line + "-o 'depth.####.exr'");
  expect_success("gbuffer 'scene:meadow?size=64x36&seed=2' -q -o one.exr");
  tools::Image a, b;
  ASSERT_TRUE(tools::read_image(path("depth.0002.exr"), &a).ok());
  ASSERT_TRUE(tools::read_image(path("one.exr"), &b).ok());
  ASSERT_EQ(a.channels.size(), b.channels.size());
  EXPECT_EQ(a.find("Z")->values, b.find("Z")->values);
  const CommandResult r = run(line + "--skip-existing -o 'depth.####.exr'");
  EXPECT_EQ(r.err, "");
  expect_failure("gbuffer 'depth.####.exr' --frames 1-3 -q -o 'g.#.exr'", 2, "is a depth image");
}

TEST_F(SequenceTest, VolumesOverTime) {
  const std::string volume = "volume 'volume:gyroid?size=24&seed=#' --size 32x32 -q ";
  expect_success(volume + "--frames 1-3 -o 'v.%03d.exr' --fields 'f.%03d.nrrd'");
  expect_success(
      "volume 'volume:gyroid?size=24&seed=2' --size 32x32 -q -o one.exr --fields one.nrrd");
  EXPECT_EQ(read_file(path("f.002.nrrd")), read_file(path("one.nrrd")));
  tools::Image a, b;
  ASSERT_TRUE(tools::read_image(path("v.002.exr"), &a).ok());
  ASSERT_TRUE(tools::read_image(path("one.exr"), &b).ok());
  EXPECT_EQ(a.channels[0].values, b.channels[0].values);
  expect_success(volume + "--frames 1-2 --fields 'only.#.nrrd'");
  EXPECT_EQ(read_file(path("only.2.nrrd")), read_file(path("one.nrrd")));
  expect_failure(volume + "--frames 1-2 -o 'v.#.exr' --fields f.nrrd", 2,
                 "--fields f.nrrd has no place for the frame's number");
}

TEST_F(SequenceTest, ResultsGoIntoTheFilesOfTheShot) {
  make_shot(2);
  expect_success(ao_ + "--frames 1-2 -o 'a.####.exr'");
  const std::string into = ao_ + "--frames 1-2 --into 'depth.####.exr' --layer ao ";
  expect_success(into);
  tools::Image a, b;
  ASSERT_TRUE(tools::read_image(path("a.0002.exr"), &a).ok());
  ASSERT_TRUE(tools::read_image(path("depth.0002.exr"), &b).ok());
  ASSERT_TRUE(b.find("ao.visibility") && b.find("Z"));
  // The depth has a guard band, which the result has not.
  EXPECT_LT(a.width, b.width);
  const int left = (b.width - a.width) / 2, top = (b.height - a.height) / 2;
  const ImageView<const float> all(b.find("ao.visibility")->values.data(), b.width, b.height);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) ASSERT_EQ(all(x + left, y + top), a.view(0)(x, y));
  }
  expect_failure(into, 2, "has a channel ao.visibility already; give --replace");
  const std::string before = read_file(path("depth.0001.exr"));
  expect_failure(into + "--replace", 1, "depth.0001.exr", "ulimit -f 4;");  // a full disk
  EXPECT_TRUE(read_file(path("depth.0001.exr")) == before);
  expect_success(into + "--replace");
  EXPECT_TRUE(read_file(path("depth.0001.exr")) == before);
  expect_failure(ao_ + "--into depth.0001.exr -o a.exr", 2, "exclude each other");
  expect_failure(ao_, 2, "--output is required, or --into");
  expect_failure(into + "--skip-existing", 2, "--skip-existing does not go with --into");
}

TEST_F(SequenceTest, MistakesAreNamed) {
  make_shot(1);
  expect_failure(ao_ + "--frames 1- -o 'a.#.exr'", 2, "--frames is '1-'");
  expect_failure(ao_ + "--frames 1 --shard 2/1 -o 'a.#.exr'", 2, "--shard is '2/1'");
  expect_failure(ao_ + "--frames 1 -o a.exr", 2, "--output a.exr has no place for the frame's");
  expect_failure(ao_ + "--frames 1 -o 'depth.%04d.exr'", 2, "is the input too");
  expect_failure(ao_ + "--frames 1 --skip-existing -o 'a.#.pfm'", 2, "--skip-existing needs EXR");
  expect_failure(ao_ + "--shard 1/2 -o 'a.#.exr'", 2, "--frames");
  expect_failure(ao_ + "-o 'a.#.exr'", 2, "for a sequence give --frames");
  expect_failure("ao depth.0001.exr --frames 1 -o 'a.#.exr'", 2, "depth.0001.exr has no place");
}

}  // namespace
}  // namespace obscura

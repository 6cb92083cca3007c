#include "io/images/atomic_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <new>

#include "io/images/files.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

// Stands for a full disk: writing beyond `bytes` of any file fails.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::size_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &old_); }

 private:
  rlimit old_ = {};
};

Image noise(int side) {
  Image image(side, side);
  std::uint32_t state = 1;
  for (float& v : image.add("Y"))
    v = static_cast<float>((state = state * 1664525 + 1013904223) >> 8) / (1 << 24);
  return image;
}

TEST_F(FilesTest, AFullDiskIsNoticedToTheLastByte) {
  const Image image = noise(64);
  for (const char* name : {"v.pfm", "v.png", "v.exr"}) {
    ASSERT_TRUE(write_image(path(name), image).ok());
    const std::size_t size = content(name).size();
    write(name, "old");
    for (std::size_t missing :
         {size, size - 1, size / 2, std::size_t{4000}, std::size_t{100}, std::size_t{1}}) {
      const FileSizeLimit limit(size - missing);
      const Status s = write_image(path(name), image);
      EXPECT_EQ(s.code(), StatusCode::kInternal) << name << " short of " << missing;
      EXPECT_EQ(s.message(), "cannot write " + path(name) + ": File too large");
      EXPECT_EQ(content(name), "old");
    }
    const FileSizeLimit limit(size);
    EXPECT_TRUE(write_image(path(name), image).ok());
    EXPECT_EQ(content(name).size(), size);
  }
  EXPECT_EQ(files_in_folder(), 3);
}

TEST_F(FilesTest, TheSignalOfTheLimitActsAsBefore) {
  const auto handler = [](int) {};
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(write_text(path("a"), "b").ok());
  EXPECT_EQ(std::signal(SIGXFSZ, SIG_DFL), static_cast<void (*)(int)>(handler));
}

TEST_F(FilesTest, WhatCannotBeWrittenIsSaidWithTheReason) {
  write("file", "in the way");
  EXPECT_EQ(write_text(path("file/x"), "a").message(),
            "cannot write " + path("file/x") + ": Not a directory");
  EXPECT_EQ(write_text(path("nowhere/x"), "a").message(),
            "cannot write " + path("nowhere/x") + ": No such file or directory");
  EXPECT_EQ(write_text(folder_, "a").message(), "cannot write " + folder_ + ": it is a folder");
  EXPECT_EQ(content("file"), "in the way");
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(FilesTest, AnExceptionWhileWritingIsAStatusAndLeavesNothing) {
  write("a", "old");
  const Status s = write_atomically(path("a"), [](const std::string& temporary) -> Status {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("lost in " + temporary);
  });
  EXPECT_EQ(s.message(), "cannot write " + path("a") + ": lost in " + path("a"));
  EXPECT_EQ(
      write_atomically(path("a"), [](const std::string&) -> Status { throw std::bad_alloc(); })
          .code(),
      StatusCode::kOutOfMemory);
  EXPECT_EQ(content("a"), "old");
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(FilesTest, LinksModesAndDevicesStayWhatTheyAre) {
  write("target", "old");
  chmod(path("target").c_str(), 0640);
  std::filesystem::create_symlink("target", path("link"));
  ASSERT_TRUE(write_text(path("link"), "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(content("target"), "new");
  struct stat info = {};
  stat(path("target").c_str(), &info);
  EXPECT_EQ(info.st_mode & 07777, 0640u);
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const int both_ends = open(path("pipe").c_str(), O_RDWR);
  ASSERT_TRUE(write_text(path("pipe"), "abc").ok());
  char read_back[4] = {};
  EXPECT_EQ(read(both_ends, read_back, 3), 3);
  EXPECT_STREQ(read_back, "abc");
  close(both_ends);
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

TEST_F(FilesTest, WhatCannotBeReadIsSaidWithTheReason) {
  std::string bytes;
  EXPECT_EQ(read_bytes(path("no"), &bytes).message(),
            "cannot read " + path("no") + ": No such file or directory");
  EXPECT_EQ(read_bytes(folder_, &bytes).message(), "cannot read " + folder_ + ": it is a folder");
  write("empty", "");
  EXPECT_EQ(read_bytes(path("empty"), &bytes).message(),
            "cannot read " + path("empty") + ": the file is empty");
  write("five", "12345");
  EXPECT_FALSE(read_bytes(path("five"), &bytes, 4).ok());
  EXPECT_TRUE(read_bytes(path("five"), &bytes, 5).ok());
  for (const char* ending : {".exr", ".pfm", ".png", ".hdr"}) {
    Image image;
    const std::string name = std::string("folder") + ending;
    std::filesystem::create_directory(path(name));
    EXPECT_EQ(read_image(path(name), &image).message(),
              "cannot read " + path(name) + ": it is a folder");
  }
}

}  // namespace
}  // namespace obscura::tools

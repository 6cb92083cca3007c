#include "io/rasters/hull_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fmt/format.h"
#include "io/images/atomic_file.h"

namespace obscura::tools {
namespace {

constexpr char kMagic[8] = {'O', 'B', 'S', 'H', 'U', 'L', 'L', '1'};
constexpr std::size_t kBuffer = std::size_t{1} << 22;
constexpr std::uint64_t kMostSweeps = 1 << 24;

}  // namespace

HullFile::~HullFile() {
  if (file_ < 0) return;
  close(file_);
  if (writes_) unlink((path_ + ".part").c_str());
}

Status HullFile::failed(const char* verb) const {
  return {StatusCode::kInternal, fmt::format("cannot {} {}: {}", verb, path_, strerror(errno))};
}

Status HullFile::damaged() const {
  return invalid_input(path_ + " is no file of hulls, or damaged; remove it with its folder");
}

Status HullFile::load() {
  file_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info = {};
  if (file_ < 0 || fstat(file_, &info) != 0) return failed("read");
  size_ = static_cast<std::uint64_t>(info.st_size);
  End end;
  if (size_ < sizeof end) return damaged();
  if (Status s = read(size_ - sizeof end, &end, sizeof end); !s.ok()) return s;
  if (std::memcmp(end.magic, kMagic, sizeof kMagic) != 0 ||
      end.columns != static_cast<std::uint64_t>(columns_) || end.sweeps > kMostSweeps) {
    return damaged();
  }
  sweeps_.resize(end.sweeps);
  return read(end.table, sweeps_.data(), sweeps_.size() * sizeof(Sweep));
}

Status HullFile::create() {
  writes_ = true;
  file_ = open((path_ + ".part").c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) return failed("write");
  buffer_.reserve(kBuffer);
  return {};
}

Status HullFile::write(const void* bytes, std::size_t size) {
  if (buffer_.size() + size > kBuffer) {
    if (Status s = flush(); !s.ok()) return s;
  }
  const char* from = static_cast<const char*>(bytes);
  buffer_.insert(buffer_.end(), from, from + size);
  size_ += size;
  return {};
}

Status HullFile::flush() {
  const IgnoreFileSizeSignal guard;
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t count = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno != EINTR) return failed("write");
    done += static_cast<std::size_t>(std::max<ssize_t>(0, count));
  }
  buffer_.clear();
  return {};
}

Status HullFile::read(std::uint64_t offset, void* bytes, std::size_t size) const {
  if (offset > size_ || size > size_ - offset) return damaged();
  char* to = static_cast<char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = pread(file_, to + done, size - done, static_cast<off_t>(offset + done));
    if (count == 0) return damaged();
    if (count < 0 && errno != EINTR) return failed("read");
    done += static_cast<std::size_t>(std::max<ssize_t>(0, count));
  }
  return {};
}

Status HullFile::end_sweep() {
  if (sweep_ < 0) return {};
  sweeps_.push_back({sweep_, size_});
  return write(places_.data(), places_.size() * sizeof(Place));
}

Status HullFile::begin(int sweep) {
  if (writes_) {
    if (Status s = end_sweep(); !s.ok()) return s;
    sweep_ = sweep;
    places_.assign(columns_, {});
    return {};
  }
  const auto found = std::ranges::find(sweeps_, sweep, &Sweep::number);
  if (found == sweeps_.end()) return damaged();
  places_.resize(columns_);
  return read(found->places, places_.data(), places_.size() * sizeof(Place));
}

Status HullFile::put(int column, std::span<const TerrainHullPoint> hull) {
  const std::lock_guard lock(mutex_);
  places_[column] = {size_, hull.size()};
  return write(hull.data(), hull.size_bytes());
}

Status HullFile::get(int column, std::vector<TerrainHullPoint>* hull) {
  const Place place = places_[column];
  if (place.count > size_ / sizeof(TerrainHullPoint)) return damaged();
  hull->resize(place.count);
  return read(place.offset, hull->data(), place.count * sizeof(TerrainHullPoint));
}

Status HullFile::finish() {
  if (Status s = end_sweep(); !s.ok()) return s;
  End end;
  std::memcpy(end.magic, kMagic, sizeof kMagic);
  end.columns = static_cast<std::uint64_t>(columns_);
  end.sweeps = sweeps_.size();
  end.table = size_;
  if (Status s = write(sweeps_.data(), sweeps_.size() * sizeof(Sweep)); !s.ok()) return s;
  if (Status s = write(&end, sizeof end); !s.ok()) return s;
  if (Status s = flush(); !s.ok()) return s;
  const int file = file_;
  file_ = -1;
  if (close(file) != 0) return failed("write");
  if (std::rename((path_ + ".part").c_str(), path_.c_str()) != 0) return failed("write");
  return {};
}

}  // namespace obscura::tools

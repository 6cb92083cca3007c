#ifndef OBSCURA_IO_RASTERS_HULL_FILE_H_
#define OBSCURA_IO_RASTERS_HULL_FILE_H_

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "obscura/terrain.h"

namespace obscura::tools {

// What a band of a terrain model hands to the next one, as a file: points first, for each sweep
// then where those of each column lie, at the end a table of the sweeps. Memory holds the columns
// of one sweep and a buffer.
class HullFile final : public TerrainHulls {
 public:
  // A file that is read, or one to be written, of a model of so many columns. Nothing happens
  // before load or create.
  HullFile(std::string path, int columns) : path_(std::move(path)), columns_(columns) {}
  ~HullFile() override;
  HullFile(const HullFile&) = delete;
  HullFile& operator=(const HullFile&) = delete;

  Status load();
  Status create();
  // Ends a file that was created; it has its name only now.
  Status finish();

  Status begin(int sweep) override;
  Status put(int column, std::span<const TerrainHullPoint> hull) override;
  Status get(int column, std::vector<TerrainHullPoint>* hull) override;

 private:
  struct Place {
    std::uint64_t offset = 0, count = 0;  // bytes from the file's start, points
  };
  struct Sweep {
    std::int64_t number = 0;
    std::uint64_t places = 0;
  };
  struct End {
    char magic[8] = {};
    std::uint64_t columns = 0, sweeps = 0, table = 0;
  };

  Status write(const void* bytes, std::size_t size);
  Status flush();
  Status end_sweep();
  Status read(std::uint64_t offset, void* bytes, std::size_t size) const;
  Status failed(const char* verb) const;
  Status damaged() const;

  const std::string path_;
  const int columns_;
  int file_ = -1;
  bool writes_ = false;
  std::uint64_t size_ = 0;  // written or to be read
  std::vector<char> buffer_;
  std::int64_t sweep_ = -1;
  std::vector<Place> places_;  // of the sweep at hand, by column
  std::vector<Sweep> sweeps_;
  std::mutex mutex_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_RASTERS_HULL_FILE_H_

#ifndef OBSCURA_APPS_MPI_SHARED_FILE_H_
#define OBSCURA_APPS_MPI_SHARED_FILE_H_

#include <mpi.h>

#include <optional>
#include <span>
#include <string>

#include "apps/mpi/ranks.h"
#include "io/images/atomic_file.h"

namespace obscura::mpi {

// A file that all ranks write their parts of (MPI-IO), and that is whole or not there: it takes its
// name in the end. All functions but write are called by all ranks.
class SharedFile {
 public:
  SharedFile(const Ranks& ranks, const std::string& path);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  const std::string& unfinished() const { return unfinished_; }
  Status open();
  Status write(std::int64_t offset, const void* bytes, std::int64_t count);
  // `bytes`: the whole file's.
  Status finish(const Status& written, std::int64_t bytes);

 private:
  const Ranks& ranks_;
  const std::string path_, unfinished_;
  tools::TemporaryName registered_;  // removed by a signal too
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace obscura::mpi

#endif  // OBSCURA_APPS_MPI_SHARED_FILE_H_

#ifndef OBSCURA_APPS_MPI_RANKS_H_
#define OBSCURA_APPS_MPI_RANKS_H_

#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "obscura/status.h"

namespace obscura::mpi {

// The ranks of a job, for as long as this lasts.
class Ranks {
 public:
  Ranks(int* argc, char*** argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool first() const { return rank_ == 0; }

  // Called by all ranks: every rank gets the error of the lowest one that has any. `own`: the error
  // is one rank's alone, so that the message names it.
  Status agree(const Status& mine, bool own = true) const;
  // Ends the whole job, where the other ranks wait for this one.
  [[noreturn]] void abort(const Status& status, const std::string& unfinished) const;

  // Fails where a rank's text is not that of rank 0.
  Status same(const std::string& what, const std::string& text) const;

 private:
  int rank_ = 0, count_ = 1;
};

int exit_code(const Status& status);
// One line on stderr.
void print_error(const std::string& message);

// Faces on their way to another rank, kept until they have arrived.
template <class T>
class Faces {
 public:
  explicit Faces(std::size_t size) : size_(size) {}
  ~Faces() { wait(); }
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;

  std::span<const T> receive(int from, int tag) {
    received_.resize(size_);
    MPI_Recv(received_.data(), static_cast<int>(size_), type(), from, tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return received_;
  }
  // Room for the next face to be sent.
  std::span<T> room() {
    wait();
    sent_.resize(size_);
    return sent_;
  }
  void send(int to, int tag) {
    MPI_Isend(sent_.data(), static_cast<int>(size_), type(), to, tag, MPI_COMM_WORLD, &request_);
  }

 private:
  static MPI_Datatype type() { return sizeof(T) == sizeof(float) ? MPI_FLOAT : MPI_INT16_T; }
  void wait() { MPI_Wait(&request_, MPI_STATUS_IGNORE); }

  std::size_t size_;
  std::vector<T> received_, sent_;
  MPI_Request request_ = MPI_REQUEST_NULL;
};

}  // namespace obscura::mpi

#endif  // OBSCURA_APPS_MPI_RANKS_H_

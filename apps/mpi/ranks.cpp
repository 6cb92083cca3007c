#include "apps/mpi/ranks.h"

#include <unistd.h>

#include <cstdio>

#include "fmt/format.h"

namespace obscura::mpi {

Ranks::Ranks(int* argc, char*** argv) {
  MPI_Init(argc, argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}
Ranks::~Ranks() { MPI_Finalize(); }

Status Ranks::agree(const Status& mine, bool own) const {
  int failed = mine.ok() ? count_ : rank_, lowest = 0;
  MPI_Allreduce(&failed, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (lowest == count_) return {};
  std::string message = mine.message();
  int numbers[2] = {static_cast<int>(mine.code()), static_cast<int>(message.size())};
  MPI_Bcast(numbers, 2, MPI_INT, lowest, MPI_COMM_WORLD);
  message.resize(static_cast<std::size_t>(numbers[1]));
  MPI_Bcast(message.data(), numbers[1], MPI_CHAR, lowest, MPI_COMM_WORLD);
  return {static_cast<StatusCode>(numbers[0]),
          own && count_ > 1 ? fmt::format("rank {}: {}", lowest, message) : message};
}

void Ranks::abort(const Status& status, const std::string& unfinished) const {
  unlink(unfinished.c_str());
  print_error(fmt::format("rank {}: {}", rank_, status.message()));
  MPI_Abort(MPI_COMM_WORLD, exit_code(status));
  _exit(exit_code(status));
}

Status Ranks::same(const std::string& what, const std::string& text) const {
  std::string of_first = text;
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
  of_first.resize(static_cast<std::size_t>(size));
  MPI_Bcast(of_first.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
  Status mine;
  if (of_first != text) {
    mine =
        invalid_argument(fmt::format("has other {} than rank 0, '{}' and '{}'; start all ranks "
                                     "alike",
                                     what, text, of_first));
  }
  return agree(mine);
}

int exit_code(const Status& status) {
  switch (status.code()) {
    case StatusCode::kOk:
      return 0;
    case StatusCode::kInvalidArgument:
    case StatusCode::kUnsupported:
      return 2;
    case StatusCode::kInvalidInput:
      return 3;
    default:
      return 1;
  }
}

void print_error(const std::string& message) {
  std::string line = message.substr(0, 600);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
  }
  fmt::print(stderr, "obscura-mpi: {}\n", line);
  std::fflush(stderr);
}

}  // namespace obscura::mpi

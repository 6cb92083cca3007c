#include "core/run_threads.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

struct NoThreads final : Executor {
  int thread_count() const override { return 0; }
  void parallel_for(int, FunctionRef<void(int, int)>) override { FAIL(); }
};

TEST(RunThreads, ExecutorsWithoutThreadsAndNumbersOutOfRangeAreRefused) {
  NoThreads none;
  RunThreads threads;
  threads.set({.executor = &none});
  EXPECT_EQ(threads.status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(threads.status().message(), "executor has 0 threads; it must have at least 1");
  for (int count : {-1, 1025}) {
    threads.set({.threads = count});
    EXPECT_FALSE(threads.status().ok());
  }
  threads.set({.threads = 1});
  EXPECT_TRUE(threads.status().ok());
  EXPECT_EQ(threads.executor().thread_count(), 1);
}

}  // namespace
}  // namespace obscura

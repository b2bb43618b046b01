#include "edgevo/core/run_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace edgevo {
namespace {

TEST(RunParallel, EachTurnRunsOnce) {
  for (const int threads : {0, 1, 3, 50}) {
    std::vector<std::atomic<int>> runs(20);
    run_parallel(5, 20, threads, [&](int i) { ++runs[size_t(i)]; });
    for (size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i], i >= 5 ? 1 : 0) << threads << " threads, turn " << i;
  }
}

TEST(RunParallel, NothingToDo) {
  run_parallel(3, 3, 4, [](int) { FAIL(); });
  run_parallel(3, 1, 4, [](int) { FAIL(); });
}

TEST(RunParallel, AnExceptionEndsTheLoopAndComesOut) {
  std::atomic<int> runs{0};
  EXPECT_THROW(run_parallel(0, 1000000, 4,
                            [&](int i) {
                              ++runs;
                              if (i == 10) throw std::runtime_error("ten");
                            }),
               std::runtime_error);
  EXPECT_LT(runs, 1000000);
}

}  // namespace
}  // namespace edgevo

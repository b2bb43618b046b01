// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/run_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace edgevo {
namespace {

TEST(RunParallel, EachIterationRunsOnce) {
  for (const int threads : {0, 1, 3, 50}) {
    std::vector<std::atomic<int>> runs(20);
    run_parallel(5, 20, threads, [&](int i) { ++runs[size_t(i)]; });
    for (size_t i = 0; i < runs.size(); ++i)
      EXPECT_EQ(runs[i], i >= 5 ? 1 : 0) << threads << " threads, turn " << i;
  }
}

TEST(RunParallel, NothingToDo) {
  run_parallel(3, 3, 4, [](int) { FAIL(); });
  run_parallel(3, 1, 4, [](int) { FAIL(); });
}

TEST(RunParallel, AnExceptionEndsTheLoopAndIsRethrown) {
  std::atomic<int> runs{0};
  const auto fail_from_ten = [&](int i) {
    ++runs;
    if (i >= 10) throw std::runtime_error("ten");
  };
  EXPECT_THROW(run_parallel(0, 1000, 4, fail_from_ten), std::runtime_error);
  EXPECT_GE(runs, 11);
  EXPECT_LE(runs, 10 + 4) << "each thread ends at its first exception, however late it is";
}

}  // namespace
}  // namespace edgevo

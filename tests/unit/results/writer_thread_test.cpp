// SPDX-License-Identifier: BSD-3-Clause
#include "writer_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace edgevo {
namespace {

TEST(WriterThread, RunsItsTasksInOrderInAnotherThread) {
  std::vector<int> done;
  std::thread::id thread;
  {
    WriterThread writer;
    for (int i = 0; i < 3 * int(WriterThread::kMax); ++i) writer.post([&done, i] { done.push_back(i); });
    writer.post([&thread] { thread = std::this_thread::get_id(); });
    writer.wait();
    ASSERT_EQ(done.size(), 3 * WriterThread::kMax);
    for (int i = 0; i < int(done.size()); ++i) EXPECT_EQ(done[size_t(i)], i);
    EXPECT_NE(thread, std::this_thread::get_id());
    writer.post([&done] { done.push_back(-1); });
  }
  EXPECT_EQ(done.back(), -1) << "it ends after its tasks";
}

TEST(WriterThread, ASlowTaskHoldsNobodyUpUntilManyWait) {
  WriterThread writer;
  std::atomic<bool> go_on{false};
  std::atomic<int> done{0};
  writer.post([&] {
    while (!go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  for (size_t i = 0; i + 1 < WriterThread::kMax; ++i) writer.post([&done] { ++done; });
  EXPECT_EQ(done, 0);
  go_on = true;
  writer.wait();
  EXPECT_EQ(done, int(WriterThread::kMax) - 1);
}

TEST(WriterThread, AFailureIsThrownOnceAndEndsTheWork) {
  WriterThread writer;
  int done = 0;
  writer.post([] { throw std::runtime_error("disk"); });
  EXPECT_THROW(writer.wait(), std::runtime_error);
  writer.post([&done] { ++done; });
  writer.wait();
  EXPECT_EQ(done, 0);
}

}  // namespace
}  // namespace edgevo

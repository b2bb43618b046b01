// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace edgevo {
namespace {

// Holds a worker up until it is opened.
class Gate {
 public:
  void operator()() const {
    while (!open_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void open() { open_ = true; }

 private:
  std::atomic<bool> open_{false};
};

// Waits until the worker has begun what it was given: nothing of it waits in the queue then.
void begin_to_wait(Worker* worker, Gate* gate) {
  std::atomic<bool> has_begun{false};
  worker->submit([&has_begun, gate] {
    has_begun = true;
    (*gate)();
  });
  while (!has_begun) std::this_thread::yield();
}

TEST(Worker, WorksInOrderInAnotherThread) {
  std::vector<int> done;
  std::thread::id thread;
  {
    Worker worker({"test", 2});
    for (int i = 0; i < 20; ++i) worker.submit_when_room([&done, i] { done.push_back(i); });
    worker.submit([&thread] { thread = std::this_thread::get_id(); });
    worker.wait_idle();
    ASSERT_EQ(done.size(), 20u);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(done[size_t(i)], i);
    EXPECT_NE(thread, std::this_thread::get_id());
    worker.submit([&done] { done.push_back(-1); });
  }
  EXPECT_EQ(done.back(), -1) << "it ends after its work";
}

TEST(Worker, WithoutAThreadTheCallerDoesTheWork) {
  WorkerOptions options{"test", 1};
  options.own_thread = false;
  Worker worker(options);
  std::thread::id thread;
  worker.submit([&thread] { thread = std::this_thread::get_id(); });
  EXPECT_EQ(thread, std::this_thread::get_id());
  EXPECT_THROW(worker.submit([] { throw std::runtime_error("now"); }), std::runtime_error);
  EXPECT_TRUE(worker.is_idle());
  worker.wait_idle();
}

TEST(Worker, AFullQueueRefusesOrGivesItsOldest) {
  Worker worker({"test", 2});
  Gate gate;
  begin_to_wait(&worker, &gate);
  std::vector<int> done;
  const auto work = [&done](int i) { return [&done, i] { done.push_back(i); }; };
  EXPECT_TRUE(worker.submit_if_room(work(1)));
  EXPECT_TRUE(worker.submit_if_room(work(2)));
  EXPECT_FALSE(worker.submit_if_room(work(3)));
  EXPECT_TRUE(worker.submit_over_oldest(work(4))) << "in place of 1";
  worker.submit(work(5));
  EXPECT_FALSE(worker.is_idle());
  gate.open();
  worker.wait_idle();
  EXPECT_TRUE(worker.is_idle());
  EXPECT_EQ(done, (std::vector<int>{2, 4, 5}));
}

TEST(Worker, WhatWaitsIsDroppedAtTheEndWhereThatIsWanted) {
  std::atomic<int> done{0};
  Gate gate;
  std::thread opens;
  {
    WorkerOptions options{"test", 5};
    options.drops_at_end = true;
    Worker worker(options);
    begin_to_wait(&worker, &gate);
    for (int i = 0; i < 3; ++i) worker.submit([&done] { ++done; });
    opens = std::thread([&gate] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      gate.open();
    });
  }
  opens.join();
  EXPECT_EQ(done, 0);
}

TEST(Worker, AFailureIsThrownOnceAndEndsTheWork) {
  Worker worker({"test", 5});
  int done = 0;
  worker.submit([] { throw std::runtime_error("disk"); });
  EXPECT_THROW(worker.wait_idle(), std::runtime_error);
  worker.submit([&done] { ++done; });
  worker.wait_idle();
  EXPECT_EQ(done, 0);
}

TEST(Worker, AFailureIsThrownByTheNextWorkToo) {
  Worker worker({"test", 5});
  worker.submit([] { throw std::runtime_error("disk"); });
  while (!worker.is_idle()) std::this_thread::yield();
  EXPECT_THROW(worker.submit_if_room([] {}), std::runtime_error);
}

TEST(Worker, AResultComesOrThrowsByItself) {
  Worker worker({"test", 5});
  EXPECT_EQ(worker.begin([] { return 7; }).get(), 7);
  std::future<int> failed = worker.begin([]() -> int { throw std::runtime_error("none"); });
  EXPECT_THROW(failed.get(), std::runtime_error);
  EXPECT_EQ(worker.begin([] { return 8; }).get(), 8) << "the worker goes on";
}

TEST(Worker, WhatComesAfterItsEndIsDropped) {
  Worker worker({"test", 2});
  std::atomic<int> done{0};
  std::atomic<bool> stop{false};
  std::thread other([&] {
    while (!stop) worker.submit_over_oldest([&done] { ++done; });
  });
  worker.submit([&done] { ++done; });
  worker.finish();
  const int before = done;
  worker.submit([&done] { ++done; });
  stop = true;
  other.join();
  worker.wait_idle();
  EXPECT_EQ(done, before);
}

TEST(BoundedQueue, GivesWhatWaitsAfterItIsClosed) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.push_if_room(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_FALSE(queue.push_if_room(3));
  std::optional<int> oldest;
  EXPECT_TRUE(queue.push_over_oldest(4, &oldest));
  EXPECT_EQ(oldest, 1);
  queue.close();
  EXPECT_FALSE(queue.push(5));
  EXPECT_FALSE(queue.push_when_room(5));
  EXPECT_FALSE(queue.push_over_oldest(5, &oldest));
  EXPECT_FALSE(queue.is_finished());
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop_within(std::chrono::seconds(1)), 4);
  EXPECT_TRUE(queue.is_finished());
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, WaitsNoLongerThanRequested) {
  BoundedQueue<int> queue(1);
  EXPECT_EQ(queue.pop_within(std::chrono::milliseconds(1)), std::nullopt);
  EXPECT_FALSE(queue.is_finished());
}

}  // namespace
}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
// The stream of events: order, cursors, threads, and what is kept.
#include "edgevo/map/map_log.h"

#include <gtest/gtest.h>

#include <thread>

namespace edgevo {
namespace {

MapEvent mapped(int frame_index) { return FrameMapped{frame_index, {}}; }

std::vector<int> read(MapCursor* cursor) {
  std::vector<int> indices;
  for (const auto& event : cursor->read()) indices.push_back(std::get<FrameMapped>(*event).frame_index);
  return indices;
}

using Indices = std::vector<int>;

TEST(MapLog, EachCursorReadsAllEventsOnceInTheirOrder) {
  const auto log = std::make_shared<MapLog>();
  MapCursor a(log), b(log);
  log->append(mapped(1));
  log->append(mapped(2));
  EXPECT_EQ(read(&a), (Indices{1, 2}));
  EXPECT_EQ(read(&a), Indices{});
  log->append(mapped(3));
  EXPECT_EQ(read(&b), (Indices{1, 2, 3}));
  EXPECT_EQ(read(&a), Indices{3});
}

TEST(MapLog, ACursorBeginsAtTheNextEvent) {
  const auto log = std::make_shared<MapLog>();
  MapCursor early(log);
  log->append(mapped(1));
  MapCursor late(log);
  log->append(mapped(2));
  EXPECT_EQ(read(&late), Indices{2});
  EXPECT_EQ(read(&early), (Indices{1, 2}));
}

TEST(MapLog, KeepsWhatSomeCursorHasNotPassed) {
  const auto log = std::make_shared<MapLog>();
  log->append(mapped(0));
  EXPECT_EQ(log->kept(), 0u) << "nobody follows";
  MapCursor fast(log);
  {
    MapCursor slow(log);
    log->append(mapped(1));
    (void)fast.read();
    EXPECT_EQ(log->kept(), 1u);
  }
  EXPECT_EQ(log->kept(), 0u) << "the slow one is gone";
  log->append(mapped(2));
  EXPECT_EQ(read(&fast), Indices{2});
  EXPECT_EQ(log->kept(), 0u);
}

TEST(MapLog, ACursorCanBeMoved) {
  const auto log = std::make_shared<MapLog>();
  MapCursor first(log);
  log->append(mapped(1));
  MapCursor moved = std::move(first);
  EXPECT_EQ(read(&moved), Indices{1});
  EXPECT_EQ(log->kept(), 0u);
}

// Two threads append while two others read: the events of each keep their order, and both readers see the
// same order.
TEST(MapLog, ThreadsSeeOneOrder) {
  constexpr int kEvents = 2000;
  const auto log = std::make_shared<MapLog>();
  std::vector<int> seen[2];
  std::vector<std::thread> threads;
  std::vector<MapCursor> cursors;
  cursors.emplace_back(log);
  cursors.emplace_back(log);
  for (int r : {0, 1})
    threads.emplace_back([&, r] {
      while (seen[r].size() < 2 * kEvents)
        for (const int index : read(&cursors[size_t(r)])) seen[r].push_back(index);
    });
  for (int w : {0, 1})
    threads.emplace_back([&, w] {
      for (int i = 0; i < kEvents; ++i) log->append(mapped(2 * i + w));
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(seen[0], seen[1]);
  int next[2] = {0, 1};
  for (const int index : seen[0]) {
    EXPECT_EQ(index, next[index % 2]);
    next[index % 2] += 2;
  }
  EXPECT_EQ(log->kept(), 0u);
}

}  // namespace
}  // namespace edgevo

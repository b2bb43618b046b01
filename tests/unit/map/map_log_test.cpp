// SPDX-License-Identifier: BSD-3-Clause
// The stream of events: order, cursors, threads, and what is kept.
#include "edgevo/map/map_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
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

// ---- constraints ----

Constraint between(int from, int to) {
  Constraint c;
  c.from = NodeId::keyframe(from), c.to = NodeId::keyframe(to);
  c.kind = ConstraintKind::kPlace;
  return c;
}

TEST(MapLog, NumbersConstraintsInTheirOrder) {
  const auto log = std::make_shared<MapLog>();
  log->append(KeyframeAdded{3, 0, 0});
  log->append(KeyframeAdded{5, 4, 0});
  MapCursor cursor(log);
  EXPECT_EQ(log->add_constraint(between(3, 5)), 0);
  EXPECT_EQ(log->add_constraint(between(5, 3)), 1);
  log->withdraw_constraint(0);
  const auto events = cursor.read();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(std::get<ConstraintAdded>(*events[1]).id, 1);
  EXPECT_EQ(std::get<ConstraintAdded>(*events[1]).constraint.from, NodeId::keyframe(5));
  EXPECT_EQ(std::get<ConstraintWithdrawn>(*events[2]).id, 0);
}

TEST(MapLog, RefusesWhatIsNoConstraint) {
  const auto log = std::make_shared<MapLog>();
  log->append(KeyframeAdded{3, 0, 0});
  log->append(KeyframeAdded{5, 4, 0});
  MapCursor cursor(log);
  std::vector<Constraint> wrong(6, between(3, 5));
  wrong[0].to = NodeId::keyframe(4);  // no such keyframe
  wrong[1].to = NodeId::epoch(0, 0);
  wrong[2].to = wrong[2].from;
  wrong[3].T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), {0, NAN, 0});
  wrong[4].covariance(2, 2) = -1;
  wrong[5].T_from_to.scale = 0;
  for (const Constraint& c : wrong) EXPECT_THROW(log->add_constraint(c), std::invalid_argument);
  EXPECT_THROW(log->withdraw_constraint(0), std::invalid_argument);
  EXPECT_TRUE(cursor.read().empty());
  EXPECT_EQ(log->add_constraint(between(3, 5)), 0);
  log->withdraw_constraint(0);
  EXPECT_THROW(log->withdraw_constraint(0), std::invalid_argument) << "it is none any more";
}

}  // namespace
}  // namespace edgevo

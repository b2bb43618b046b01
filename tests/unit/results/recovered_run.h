// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs from events, and whether two runs are the same to the last bit.
#include <gtest/gtest.h>

#include <vector>

#include "edgevo/map/run_builder.h"
#include "edgevo/results/run_text.h"

namespace edgevo::test {

/// The run that events make if nothing comes after them.
inline Run run_from(const Pinhole& pinhole, const std::vector<MapEvent>& events) {
  RunBuilder builder(pinhole);
  for (const MapEvent& event : events) builder.apply(event);
  builder.adopt_window();
  return builder.finish();
}

inline bool is_same(const SE3& a, const SE3& b) {
  return a.translation() == b.translation() && a.rotation().coeffs() == b.rotation().coeffs();
}

inline bool is_same(const std::optional<SE3>& a, const std::optional<SE3>& b) {
  return a.has_value() == b.has_value() && (!a || is_same(*a, *b));
}

inline bool is_same(const EdgePoint& a, const EdgePoint& b) {
  return a.px == b.px && a.normal == b.normal && a.idepth == b.idepth && a.idepth_sigma == b.idepth_sigma &&
         a.observations == b.observations && a.gray == b.gray;
}

inline bool is_same(const EdgeVertex& a, const EdgeVertex& b) {
  return a.px == b.px && a.idepth == b.idepth && a.idepth_sigma == b.idepth_sigma;
}

inline bool is_same(const EdgeLine& a, const EdgeLine& b);

template <class T>
bool are_same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return is_same(x, y); });
}

inline bool is_same(const EdgeLine& a, const EdgeLine& b) {
  return are_same(a.vertices, b.vertices) && a.keyframes == b.keyframes && a.views == b.views &&
         a.source == b.source && a.is_outline == b.is_outline;
}

/// Poses and points; lines and CPU times may differ.
inline void expect_same_map(const Run& a, const Run& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_TRUE(is_same(a.frames[i].T_world_cam, b.frames[i].T_world_cam)) << i;
    EXPECT_TRUE(is_same(a.frames[i].T_world_cam_live, b.frames[i].T_world_cam_live)) << i;
    EXPECT_EQ(a.frames[i].covariance, b.frames[i].covariance) << i;
  }
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (size_t k = 0; k < a.keyframes.size(); ++k) {
    EXPECT_EQ(a.keyframes[k].frame_index, b.keyframes[k].frame_index);
    EXPECT_TRUE(is_same(a.keyframes[k].T_world_cam, b.keyframes[k].T_world_cam)) << k;
    EXPECT_TRUE(are_same(a.keyframes[k].points, b.keyframes[k].points)) << k;
  }
}

inline void expect_same_run(const Run& a, const Run& b) {
  expect_same_map(a, b);
  EXPECT_EQ(frames_csv(a), frames_csv(b));
  for (size_t k = 0; k < a.keyframes.size(); ++k)
    EXPECT_TRUE(are_same(a.keyframes[k].lines, b.keyframes[k].lines)) << k;
  EXPECT_EQ(a.camera.given.keyframes, b.camera.given.keyframes);
}

}  // namespace edgevo::test

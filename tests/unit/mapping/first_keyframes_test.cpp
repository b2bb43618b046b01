// SPDX-License-Identifier: BSD-3-Clause
// Which views of a bootstrap become keyframes.
#include "first_keyframes.h"

#include <gtest/gtest.h>

#include <memory>

namespace edgevo {
namespace {

std::vector<BootstrapView> views_with_images(int n) {
  const auto image = std::make_shared<const FramePyramid>();
  std::vector<BootstrapView> views(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) views[i].frame_index = i, views[i].pyramid = image, views[i].placed = true;
  return views;
}

std::vector<int> chosen_of(const std::vector<BootstrapView>& views) {
  std::vector<int> frames;
  for (const BootstrapView* v : choose_keyframe_views(views)) frames.push_back(v->frame_index);
  return frames;
}

TEST(FirstKeyframes, ThreeViewsBetweenAreSpreadEvenly) {
  EXPECT_EQ(chosen_of(views_with_images(11)), (std::vector<int>{0, 2, 5, 8, 10}));
}

TEST(FirstKeyframes, UsesFewerViewsIfThereAreFewer) {
  EXPECT_EQ(chosen_of(views_with_images(2)), (std::vector<int>{0, 1}));
  EXPECT_EQ(chosen_of(views_with_images(4)), (std::vector<int>{0, 1, 2, 3}));
}

TEST(FirstKeyframes, AViewWithoutPoseOrImageIsNotUsed) {
  std::vector<BootstrapView> views = views_with_images(5);
  views[1].placed = false, views[3].pyramid.reset();
  EXPECT_EQ(chosen_of(views), (std::vector<int>{0, 2, 4}));
}

}  // namespace
}  // namespace edgevo

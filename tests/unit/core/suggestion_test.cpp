// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/suggestion.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(DidYouMean, NamesACloseWordAndKeepsQuietOtherwise) {
  const std::vector<std::string> keys{"image_width", "camera_matrix", "d"};
  EXPECT_EQ(did_you_mean("image_widht", keys), "did you mean 'image_width'?");
  EXPECT_EQ(did_you_mean("camera_matrx", keys), "did you mean 'camera_matrix'?");
  EXPECT_EQ(did_you_mean("vignetting", keys), "");
  EXPECT_EQ(did_you_mean("x", keys), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
  EXPECT_EQ(did_you_mean(std::string(100000, 'x'), keys), "");
}

TEST(EditDistance, CountsTheFewestChanges) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
}

}  // namespace
}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/reason.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Reason, EveryKindHasWordsOfItsOwn) {
  std::vector<std::string> all;
  for (int k = int(ReasonKind::kSkipped) + 1; k <= int(kLastReasonKind); ++k) {
    const std::string text = to_string(Reason{ReasonKind(k), 0.5, 2});
    EXPECT_NE(text, "") << k;
    EXPECT_THAT(text, Not(HasSubstr("nan"))) << k;
    EXPECT_THAT(all, Not(::testing::Contains(text))) << k;
    all.push_back(text);
  }
}

TEST(Reason, GivesItsNumbers) {
  EXPECT_EQ(to_string(Reason{ReasonKind::kInlierShare, 0.123, 0.15}), "inlier share 0.12 is below 0.15");
  EXPECT_EQ(to_string(Reason{ReasonKind::kFewAgree, 0.37, 0.6}),
            "only 37 % of the corners agree on one motion, 60 % needed: much moves by itself, or images are "
            "blurred or blended");
  EXPECT_EQ(to_string(Reason{ReasonKind::kScaleByCorners, 0.6, 10}), "scale fell by 0.40 within 10 frames");
  EXPECT_EQ(to_string(Reason{ReasonKind::kScaleByCorners, 1.5, 50}),
            "scale grew by a factor of 1.50 within 50 frames");
  EXPECT_EQ(to_string(Reason{ReasonKind::kTranslationByCorners, 0.4}),
            "translation over 10 frames differs from the corners' by 40 % of its length");
  EXPECT_EQ(to_string(Reason{ReasonKind::kFocalLength, 0.2}),
            "a turn with a focal length that the corners put 20 % off");
  EXPECT_EQ(to_string(Reason{ReasonKind::kZoom, 0.031}), "the images zoom by 3.1 % within 10 frames");
  EXPECT_EQ(to_string(Reason{ReasonKind::kStep, 1e9}), "a step of 9999 times the usual one");
}

TEST(Reason, ListsAreReadInOrderAndComparedByKind) {
  const Reason image{ReasonKind::kInlierShare, 0.3, 0.4}, motion{ReasonKind::kTurn};
  EXPECT_EQ(to_string(joined({image}, {motion})),
            "inlier share 0.30 is below 0.40; a translation that the turn hides");
  EXPECT_TRUE(are_alike({image, motion}, {{ReasonKind::kInlierShare, 0.1, 0.15}, motion}));
  EXPECT_FALSE(are_alike({image}, {image, motion}));
  EXPECT_FALSE(are_alike({image}, {motion}));
}

}  // namespace
}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_index.h"

#include <gmock/gmock.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

// A view of random corners and signature.
RememberedView random_view(uint64_t seed, int corners = 200) {
  Random random(seed);
  RememberedView view;
  view.corners.descriptors = cv::Mat(corners, 32, CV_8U);
  for (int i = 0; i < corners; ++i) {
    view.corners.px.emplace_back(float(random.uniform(0, 600)), float(random.uniform(0, 400)));
    for (int b = 0; b < 32; ++b) view.corners.descriptors.at<uint8_t>(i, b) = uint8_t(random.uniform(0, 256));
  }
  for (uint64_t& bits : view.signature.bits)
    bits = uint64_t(random.uniform(0, 4294967296.0)) << 32 | uint64_t(random.uniform(0, 4294967296.0));
  return view;
}

// The same view with a share of all bits changed.
RememberedView changed(RememberedView view, double share, uint64_t seed) {
  Random random(seed);
  view.corners.descriptors = view.corners.descriptors.clone();
  for (int i = 0; i < view.corners.descriptors.rows; ++i)
    for (int b = 0; b < 256; ++b)
      if (random.uniform(0, 1) < share) view.corners.descriptors.at<uint8_t>(i, b / 8) ^= uint8_t(1 << b % 8);
  for (uint64_t& bits : view.signature.bits)
    for (int b = 0; b < 64; ++b)
      if (random.uniform(0, 1) < share) bits ^= uint64_t(1) << b;
  return view;
}

TEST(PlaceIndex, NominatesThePlaceThatLooksAlike) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 100; ++i) EXPECT_EQ(index.add(random_view(i)), int(i));
  for (const int place : {3, 40, 99}) {
    const std::vector<int> found = index.candidates(changed(random_view(uint64_t(place)), 0.12, 500), 100, 3);
    ASSERT_THAT(found, SizeIs(3));
    EXPECT_EQ(found.front(), place);
  }
}

TEST(PlaceIndex, OneVoterIsEnough) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 100; ++i) index.add(random_view(i));
  RememberedView only_signature = changed(random_view(30), 0.1, 1);
  only_signature.corners = {};
  EXPECT_EQ(index.candidates(only_signature, 100, 2).front(), 30);
  RememberedView only_corners = changed(random_view(60), 0.1, 2);
  only_corners.signature = random_view(1000).signature;
  EXPECT_THAT(index.candidates(only_corners, 100, 2), ::testing::Contains(60));
}

TEST(PlaceIndex, KnowsNothingBeyondTheEnd) {
  PlaceIndex index;
  EXPECT_THAT(index.candidates(random_view(1), 0, 3), IsEmpty());
  for (uint64_t i = 0; i < 50; ++i) index.add(random_view(i));
  for (const int found : index.candidates(random_view(40), 20, 3)) EXPECT_LT(found, 20);
}

TEST(PlaceIndex, CandidatesAreNoNeighbours) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 60; ++i) index.add(changed(random_view(1), 0.05, i));
  const std::vector<int> found = index.candidates(random_view(1), 60, 5);
  for (size_t i = 0; i < found.size(); ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_GE(std::abs(found[i] - found[j]), 6);
}

TEST(PlaceIndex, ViewsWithoutCornersDoNoHarm) {
  PlaceIndex index;
  index.add({});
  index.add(random_view(1));
  EXPECT_THAT(index.candidates({}, 2, 1), SizeIs(1));
}

}  // namespace
}  // namespace edgevo

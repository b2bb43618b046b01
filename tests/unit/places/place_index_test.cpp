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
  view.corners.descriptors.resize(size_t(corners));
  for (int i = 0; i < corners; ++i) {
    view.corners.px.emplace_back(float(random.uniform(0, 600)), float(random.uniform(0, 400)));
    for (uint8_t& byte : view.corners.descriptors[size_t(i)]) byte = uint8_t(random.uniform(0, 256));
  }
  for (uint64_t& bits : view.signature.bits)
    bits = uint64_t(random.uniform(0, 4294967296.0)) << 32 | uint64_t(random.uniform(0, 4294967296.0));
  return view;
}

// The same view with a share of all bits changed.
RememberedView changed(RememberedView view, double share, uint64_t seed) {
  Random random(seed);
  for (CornerDescriptor& d : view.corners.descriptors)
    for (size_t b = 0; b < 256; ++b)
      if (random.uniform(0, 1) < share) d[b / 8] ^= uint8_t(1 << b % 8);
  for (uint64_t& bits : view.signature.bits)
    for (int b = 0; b < 64; ++b)
      if (random.uniform(0, 1) < share) bits ^= uint64_t(1) << b;
  return view;
}

// Without queries before it.
std::vector<int> candidates(const PlaceIndex& index, const RememberedView& query, size_t count) {
  PlaceVotes votes;
  return index.candidates(query, count, &votes);
}

TEST(PlaceIndex, NominatesThePlaceThatLooksAlike) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 100; ++i) EXPECT_EQ(index.add(random_view(i)), int(i));
  for (const int place : {3, 40, 99}) {
    const std::vector<int> found = candidates(index, changed(random_view(uint64_t(place)), 0.12, 500), 3);
    ASSERT_THAT(found, SizeIs(3));
    EXPECT_EQ(found.front(), place);
  }
}

TEST(PlaceIndex, OneVoterIsEnough) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 100; ++i) index.add(random_view(i));
  RememberedView only_signature = changed(random_view(90), 0.1, 1);
  only_signature.corners = {};
  EXPECT_EQ(candidates(index, only_signature, 2).front(), 90);
  RememberedView only_corners = changed(random_view(60), 0.1, 2);
  only_corners.signature = random_view(1000).signature;
  EXPECT_THAT(candidates(index, only_corners, 2), ::testing::Contains(60));
}

TEST(PlaceIndex, WithoutViewsThereAreNoCandidates) {
  PlaceIndex index;
  EXPECT_THAT(candidates(index, random_view(1), 3), IsEmpty());
}

TEST(PlaceIndex, CandidatesAreNoNeighbours) {
  PlaceIndex index;
  for (uint64_t i = 0; i < 60; ++i) index.add(changed(random_view(1), 0.05, i));
  const std::vector<int> found = candidates(index, random_view(1), 5);
  for (size_t i = 0; i < found.size(); ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_GE(std::abs(found[i] - found[j]), 6);
}

TEST(PlaceIndex, ViewsWithoutCornersDoNoHarm) {
  PlaceIndex index;
  index.add({});
  index.add(random_view(1));
  EXPECT_THAT(candidates(index, {}, 1), SizeIs(1));
}

}  // namespace
}  // namespace edgevo

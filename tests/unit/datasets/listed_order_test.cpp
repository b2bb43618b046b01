// SPDX-License-Identifier: BSD-3-Clause
// A list that shuffles images or times is as readable as any: the names show it.
#include "listed_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

// Doubt about images of these names, 0.1 s apart from 1000 s on; empty if there is none.
std::string doubt_of(const std::vector<std::string>& names) {
  std::vector<Timestamp> times;
  for (size_t i = 0; i < names.size(); ++i) times.push_back(Timestamp::from_seconds(1.7e9 + 0.1 * double(i)));
  std::vector<InputDecision> decisions;
  doubt_listed_order(names, times, &decisions);
  return decisions.empty() ? "" : to_string(decisions.at(0)) + ": " + decisions.at(0).doubt;
}

std::vector<std::string> numbered(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back("images/" + std::to_string(i) + ".png");
  return names;
}

// Names that hold the times, in milliseconds, from another clock.
std::vector<std::string> timed(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i)
    names.push_back("images/" + std::to_string(1600000000000 + 100 * i) + ".png");
  return names;
}

TEST(ListedOrder, TwentyShuffledImagesAreADoubt) {
  auto names = numbered(300);
  for (size_t i = 100; i < 120; ++i) std::swap(names[i], names[100 + (i * 7) % 20]);
  EXPECT_THAT(doubt_of(names), ::testing::HasSubstr("not by the names of the images"));
  EXPECT_THAT(doubt_of(names), ::testing::HasSubstr("sort the list"));
}

TEST(ListedOrder, TimesThatAreNotThoseOfTheNamesAreADoubt) {
  auto names = timed(50);
  names.erase(names.begin() + 10);
  names.erase(names.begin() + 20);
  names.erase(names.begin() + 30);
  EXPECT_THAT(doubt_of(names), ::testing::HasSubstr("3 steps differ, first before 1600000001100.png"));
}

TEST(ListedOrder, UsualListsAreNone) {
  EXPECT_EQ(doubt_of(numbered(120)), "") << "10 follows 9";
  EXPECT_EQ(doubt_of(timed(50)), "") << "an offset of the clock";
  EXPECT_EQ(doubt_of({"b/one.png", "a/two.png", "c/three.png"}), "") << "words";
  auto one_gap = timed(50);
  one_gap.erase(one_gap.begin() + 10);
  EXPECT_EQ(doubt_of(one_gap), "") << "a clock that was set";
}

// DSO's times.txt names the images.
TEST(ListedOrder, IsSaidByTheSource) {
  const test::TempFolder folder;
  test::write_edgevo_layout(folder.path(), 6);
  std::string list;
  for (const int i : {0, 1, 4, 3, 2, 5})
    list += "00000" + std::to_string(i) + " " + std::to_string(0.1 * double(list.size())) + "\n";
  test::write_text(folder / "times.txt", list);
  SourceOptions options;
  options.path = folder.path();
  const auto source = open_source(options);
  const auto decisions = source->decisions();
  EXPECT_TRUE(std::any_of(decisions.begin(), decisions.end(), [](const InputDecision& d) {
    return d.reason.find("2 name(s) come before that of the image before") != std::string::npos;
  }));
}

}  // namespace
}  // namespace edgevo

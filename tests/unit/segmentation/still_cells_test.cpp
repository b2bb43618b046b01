// SPDX-License-Identifier: BSD-3-Clause
// The cells of the view that show that the camera stands.
#include <gtest/gtest.h>

#include "view_of_part.h"

namespace edgevo {
namespace {

using test::Body;
using test::kPartHeight;
using test::kPartWidth;
using test::MaskedBuilder;
using test::no_body;
using test::part_camera;
using test::part_view;
using test::random_blocks;
using test::receding_blocks;
using test::show;

TEST(StillCells, ShowThatTheCameraStandsFromTheThirdImageOnWhateverCrosses) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 60; ++i) {
    const double left = 12 * i - 150;
    const auto bus = [&](double x, double y) -> std::optional<double> {
      if (x < left || x > left + 200 || y < 60 || y > 260) return std::nullopt;
      return random_blocks(x - left, y, 3);
    };
    builder.build(part_view(0, 0, bus, uint64_t(i + 1)));
    EXPECT_EQ(builder.masks.still_cells().empty(), i < 2) << i;
    EXPECT_EQ(builder.masks.still_cells().images, i) << i;
  }
}

// A long one that hides four fifths of the view for thirty images.
TEST(StillCells, StandWhileABusHidesMostOfTheView) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 110; ++i) {
    const double right = 12 * i;
    const auto bus = [&](double x, double y) -> std::optional<double> {
      if (x > right || x < right - 800 || y < 50) return std::nullopt;
      return random_blocks(x - right, y, 3);
    };
    builder.build(part_view(0, 0, bus, uint64_t(i + 1)));
    EXPECT_EQ(builder.masks.still_cells().images, i) << "no map is begun";
  }
}

// One that hides all of it, for some sixty images; then the camera drives off.
TEST(StillCells, StandWhileABusHidesTheWholeView) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 130; ++i) {
    const double right = 12 * i;
    const auto bus = [&](double x, double y) -> std::optional<double> {
      if (x > right || x < right - 1000) return std::nullopt;
      return random_blocks(x - right, y, 3);
    };
    ASSERT_FALSE(builder.build(part_view(0, 0, bus, uint64_t(i + 1)))->ego_mask) << i;
    EXPECT_EQ(builder.masks.still_cells().images, i) << "no map is begun";
  }
  show(&builder, 3, 3, 1.3, no_body, 1);
  EXPECT_EQ(builder.masks.still_cells().images, 0);
}

// The bus hides all of the view, and has gone without a trace of what stood.
TEST(StillCells, MoveOnceTheCameraHasDrivenOffBehindABus) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  int moved_at = 0;
  for (int i = 0; i < 140 && !moved_at; ++i) {
    const double right = 12 * i, driven = std::max(0, i - 45);
    const auto bus = [&](double x, double y) -> std::optional<double> {
      if (x > right || x < right - 600) return std::nullopt;
      return random_blocks(x - right, y, 3);
    };
    builder.build(part_view(3 * driven, 1.3 * driven, bus, uint64_t(i + 1)));
    if (builder.masks.still_cells().images == 0 && i > 0) moved_at = i;
    EXPECT_FALSE(i >= 85 && builder.masks.still_cells().show_it()) << i;
  }
  EXPECT_GT(moved_at, 60) << "the bus still hides it";
}

TEST(StillCells, AsManyAsAColumnShowThatTheCameraStands) {
  StillCells cells;
  EXPECT_FALSE(cells.show_it());
  cells.rows = 3, cells.columns = 4;
  cells.is_still.assign(12, 0);
  cells.is_still[1] = cells.is_still[6] = 1;
  EXPECT_FALSE(cells.show_it());
  cells.is_still[11] = 1;
  EXPECT_TRUE(cells.show_it());
}

// A camera that starts so slowly that blocks of the view leave their place one after the other.
TEST(StillCells, MoveOnceTheViewHasSlidAway) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  show(&builder, 5, 0, 0, no_body);
  int moved_at = 0;
  for (int i = 1; i <= 100 && !moved_at; ++i) {
    const Body ahead = [&](double x, double y) -> std::optional<double> {
      const double size = 1 + 0.0005 * i, u = kPartWidth / 2, v = kPartHeight / 2;
      return random_blocks(u + (x - u) / size, v + (y - v) / size, 1);
    };
    builder.build(part_view(0, 0, ahead, uint64_t(i + 9)));
    if (builder.masks.still_cells().images == 0) moved_at = i;
  }
  EXPECT_GT(moved_at, 5);
}

TEST(StillCells, MoveBehindADashboardAfterAStandstill) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 60; ++i) {
    const Body dashboard = [&](double x, double y) -> std::optional<double> {
      if (y > 200) return random_blocks(x, y, 2);
      return receding_blocks(x, y, std::max(0, i - 20));
    };
    builder.build(part_view(0, 0, dashboard, uint64_t(i + 1)));
    if (i == 20) {
      EXPECT_GT(builder.masks.still_cells().images, 15);
    }
  }
  EXPECT_EQ(builder.masks.still_cells().images, 0);
}

TEST(StillCells, AreThoseThatABusDoesNotCover) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  show(&builder, 4, 3, 1.3, no_body);
  const auto bus = [](double x, double y) -> std::optional<double> {
    if (x > 250 || y < 60 || y > 260) return std::nullopt;
    return random_blocks(x - 6, y, 3);
  };
  builder.build(part_view(12, 5.2, no_body, 5));
  EXPECT_TRUE(builder.masks.still_cells().empty()) << "the view moves";
  builder.build(part_view(12, 5.2, bus, 6));
  EXPECT_TRUE(builder.masks.still_cells().empty()) << "as a slow camera would from one image to the next";
  EXPECT_EQ(builder.masks.still_cells().images, 1);
  builder.build(part_view(12, 5.2, bus, 7));
  const StillCells still = builder.masks.still_cells();
  EXPECT_FALSE(still.contain(0.25, 0.5)) << "the bus";
  EXPECT_TRUE(still.contain(0.8, 0.5));
  EXPECT_TRUE(still.contain(0.999, 0.999));
}

}  // namespace
}  // namespace edgevo

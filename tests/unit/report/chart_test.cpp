// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "axes.h"
#include "edgevo/report/palette.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ReportTicks, AreRoundAndInside) {
  EXPECT_THAT(nice_ticks(0, 10, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(nice_ticks(0.013, 0.047, 3),
              ElementsAre(::testing::DoubleNear(0.02, 1e-12), ::testing::DoubleNear(0.04, 1e-12)));
  EXPECT_TRUE(nice_ticks(1, 1, 5).empty());
}

TEST(ReportCharts, GapsAndLongSeries) {
  TimeChart chart;
  chart.y_name = "a < b";
  Series s{"s", "#000000", {}};
  for (int i = 0; i < 5000; ++i) {
    chart.x.push_back(0.1 * i);
    s.y.push_back(i > 2000 && i < 3000 ? std::nan("") : std::sin(0.01 * i));
  }
  chart.series = {s};
  const std::string svg = draw(chart);
  EXPECT_LT(svg.size(), 30000u);
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("nan")));
  const size_t line = svg.find("class=\"line\"");
  EXPECT_EQ(std::count(svg.begin() + std::ptrdiff_t(line), svg.end(), 'M'), 2) << "one gap, two pieces";
}

TimeChart two_series() {
  TimeChart chart;
  chart.y_name = "metres";
  chart.x = {0, 0.5, 1};
  chart.series = {{"estimate", palette::kBlue, {1, std::nan(""), 3}}, {"truth", "#222222", {1, 2.25, 3}}};
  return chart;
}

TEST(ReportCharts, ContainTheValuesShownUnderThePointer) {
  const std::string html = draw(two_series());
  EXPECT_THAT(html, HasSubstr("&quot;range&quot;:[0,1]"));
  EXPECT_THAT(html, HasSubstr("&quot;x&quot;:[0,0.5,1]"));
  EXPECT_THAT(html, HasSubstr("&quot;name&quot;:&quot;estimate&quot;"));
  EXPECT_THAT(html, HasSubstr("&quot;y&quot;:[1,null,3]"));
  EXPECT_THAT(html, HasSubstr("stroke:var(--blue,#1f5fbf)"));
  EXPECT_THAT(html, ::testing::Not(HasSubstr("<text"))) << "text in a stretched drawing is stretched";
}

TEST(ReportCharts, StackedValuesAreThoseOfEachSeriesAlone) {
  TimeChart chart = two_series();
  chart.stacked = true;
  EXPECT_THAT(draw(chart), HasSubstr("&quot;y&quot;:[1,2.25,3]"));
}

TEST(ReportCharts, ASeparateFileNeedsNoStyleSheet) {
  const std::string svg = draw_svg(two_series());
  EXPECT_THAT(svg, ::testing::StartsWith("<svg"));
  EXPECT_THAT(svg, HasSubstr("stroke:#1f5fbf"));
  EXPECT_THAT(svg, HasSubstr(">0.5 s</text>"));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("var(")));
}

}  // namespace
}  // namespace edgevo

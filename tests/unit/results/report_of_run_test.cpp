// SPDX-License-Identifier: BSD-3-Clause
// report.html as RunOutputs writes it, pictures and map included.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "written_run.h"

namespace edgevo {
namespace {

using test::content;
using ::testing::HasSubstr;

using ReportOfRun = WrittenRun;

TEST_F(ReportOfRun, ShowsPicturesChartsAndNotes) {
  write(folder_, made_.run, made_.camera);
  const std::string html = content(folder_ / "report.html");
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<img alt="), 8);  // six with edges, a doubtful frame, the grid
  EXPECT_EQ(count("<svg"), 9);       // from above, three over time, ribbon, three of tracking, stages
  EXPECT_EQ(count("</svg>"), count("<svg"));
  EXPECT_THAT(html, HasSubstr("grid.yaml from above"));
  EXPECT_THAT(html, HasSubstr("occupied voxels"));
  EXPECT_THAT(html, HasSubstr("LOST 5"));
  EXPECT_THAT(html, HasSubstr("lost: 3 of 400 points aligned, 120 needed"));
  EXPECT_THAT(html, HasSubstr("percentile: 0.9"));
  EXPECT_THAT(html, HasSubstr("edgevo run a &quot;quoted&quot; folder"));
  EXPECT_THAT(html, HasSubstr("No ground truth is known"));
}

}  // namespace
}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#include "trust_section.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/run_quality/guessed_places.h"
#include "frame_times.h"

namespace edgevo {
namespace {

TimeChart p_right_chart(const Run& run) {
  TimeChart chart;
  chart.y_name = "probability that the motion is right";
  chart.x = seconds_of(run);
  chart.from_zero = true;
  Series p{"p_right", palette::kBlue, {}}, limit{"doubtful below", palette::kRed, {}};
  for (const FrameRecord& f : run.frames) {
    p.y.push_back(f.p_right);
    limit.y.push_back(kDoubtfulBelow);
  }
  chart.series = {p, limit};
  return chart;
}

std::string interval_table(const Run& run) {
  constexpr size_t kMaxRows = 20;
  const std::vector<DoubtfulInterval> all = doubtful_intervals(run);
  if (all.empty()) return note_html("No frame is doubtful.");
  std::vector<std::vector<std::string>> rows;
  for (const DoubtfulInterval& d : longest(all, kMaxRows))
    rows.push_back({std::to_string(d.first_frame) + " to " + std::to_string(d.last_frame),
                    std::to_string(d.frames), why(d)});
  const std::string more =
      all.size() > kMaxRows ? note_html("The longest " + std::to_string(kMaxRows) + " of " +
                                        std::to_string(all.size()) + " intervals; all of them: summary.yaml.")
                            : "";
  return table_html({"frames", "doubtful", "mostly because"}, rows) + more;
}

std::string uncertain_lines(const Run& run) {
  std::string lines;
  for (const std::string& line : uncertain_in_words(run)) lines += note_html(line + ".");
  return lines;
}

std::string pictures(const ReportInput& in) {
  if (in.doubtful.pictures.empty()) return "";
  std::string body = "<div class=\"edges\">\n";
  for (const EdgePicture& e : in.doubtful.pictures) {
    const std::string name = "frame " + std::to_string(e.frame_index);
    body +=
        figure_html("jpeg", e.jpeg, "doubtful " + name,
                    name + ", the most doubtful of its interval, and the map as it is seen from its pose");
  }
  return body + "</div>\n";
}

}  // namespace

std::string trust_section(const ReportInput& in) {
  const bool known = std::any_of(in.run.frames.begin(), in.run.frames.end(),
                                 [](const FrameRecord& f) { return std::isfinite(f.p_right); });
  return section_html("trust", "Trust in each frame",
                      (known ? draw(p_right_chart(in.run)) : note_html("No frame has a probability.")) +
                          interval_table(in.run) + uncertain_lines(in.run) + pictures(in));
}

}  // namespace edgevo

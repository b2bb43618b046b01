// SPDX-License-Identifier: BSD-3-Clause
#include "edges_section.h"

#include "color_ramp.h"
#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"

namespace edgevo {

std::string edges_section(const ReportInput& in) {
  const EdgePictures& p = in.pictures;
  if (p.pictures.empty())
    return section_html("edges", "Edges",
                        note_html("There is no keyframe with points and an image to show."));
  const std::string unit = in.run.is_metric() ? " m" : " units";
  std::string body = "<div class=\"scale\" style=\"background:" + color_ramp_css() +
                     "\"></div><div class=\"ends\"><span>far, " + fixed(1 / p.idepth_low, 2) + unit +
                     "</span><span>inverse depth</span><span>near, " + fixed(1 / p.idepth_high, 2) + unit +
                     "</span></div>\n<div class=\"edges\">\n";
  for (const EdgePicture& e : p.pictures)
    body += figure_html("jpeg", e.jpeg, "edges of frame " + std::to_string(e.frame_index),
                        "frame " + std::to_string(e.frame_index) + ", " +
                            fixed(seconds_between(in.run.frames.front().time, e.time), 2) +
                            " s: " + std::to_string(e.points) + " points");
  return section_html("edges", "Edges by inverse depth", body + "</div>\n");
}

}  // namespace edgevo

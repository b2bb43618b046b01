// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// report.html: a run on one page that needs nothing but a browser: no network and no other file.
//
// The page shows tracking (states, inlier share, residual), the trust in each frame, the trajectory (from
// above and over time, with ground truth if known), edges coloured by inverse depth, CPU time by stage, the
// map, the unit of length and its uncertainty, the parameters, and hints on what to do next. A pure function
// of its input: except for the stage times, the same run gives the same bytes.
#include <string>
#include <vector>

#include "edgevo/report/edge_pictures.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/map_view.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// Contents of the page. Referenced objects must outlive it.
struct ReportInput {
  /// The finished run.
  const Run& run;
  /// Description of the run.
  const RunInfo& info;
  /// Filter of the edge points that are drawn.
  PointFilter points;
  /// Pictures of keyframes; may be empty.
  EdgePictures pictures;
  /// Names of files that could not be written.
  std::vector<std::string> not_written;
  /// Statistics of the map files.
  MapReport map = {};
  /// Vertices of the 3D view, in map frame and unit of the run (map_points(), map_lines()).
  std::vector<MapVertex> map_vertices = {};
  /// Pictures of doubtful frames (draw_doubtful_pictures()); may be empty.
  EdgePictures doubtful = {};
};

/// The page as HTML.
std::string report_html(const ReportInput& input);

}  // namespace edgevo

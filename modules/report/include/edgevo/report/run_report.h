#pragma once
// report.html: a run on one page that needs nothing but a browser: no network, no script, no other file.
//
// It holds what happened (states, inlier share, residual), where the camera went (from above and over time,
// with ground truth where that is known), what it saw (edges coloured by inverse depth), what it cost (CPU
// time by stage), what the map holds, in which unit and how certain that is, with which parameters, and
// what the user can do next. A pure function of its input: the same run gives the same bytes but for the
// stage times.
#include <string>
#include <vector>

#include "edgevo/report/edge_pictures.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/map_view.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// All that the page tells. References must outlive it.
struct ReportInput {
  const Run& run;  ///< finished
  const RunInfo& info;  ///< what is told besides
  PointFilter points;  ///< which edge points are drawn
  EdgePictures pictures;  ///< may be empty
  std::vector<std::string> not_written;  ///< files of the run that could not be
  MapReport map = {};                    ///< what the map files hold
  std::vector<MapVertex> map_vertices =
      {};  ///< shown in 3D; map frame and unit of the run (map_points, or lines)
};

std::string report_html(const ReportInput& input);  ///< The page.

}  // namespace edgevo

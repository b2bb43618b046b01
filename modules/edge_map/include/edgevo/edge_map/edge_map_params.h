#pragma once
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the lines of whole edges.
struct EdgeMapParams {
  std::string mode = "full";          ///< "off", "keyframes": each keyframe's own lines, "full": fused
  int views = 8;                      ///< other images that a keyframe's edges are searched for in
  int step_px = 3;                    ///< along the edge, from one searched pixel to the next
  int min_views = 3;                  ///< that must show an edge where its depth says
  int min_vertices = 4;               ///< of a line
  double sigma_px = 0.4;              ///< position noise of an edge along its normal
  double max_relative_sigma = 0.007;  ///< idepth_sigma / idepth of a vertex
  int fusion_keyframes = 12;          ///< so long a keyframe's lines wait for others that see them

  bool is_on() const { return mode != "off"; }      ///< lines are made at all
  bool is_fused() const { return mode == "full"; }  ///< each 3D edge once
  void visit(ParamVisitor& v);                      ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo

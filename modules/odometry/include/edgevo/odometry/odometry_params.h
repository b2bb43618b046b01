#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/odometry/keyframe_params.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// What is done after a loss, and where one is near.
struct RecoveryParams {
  /// frames
  int max_frames = 10;
  /// A bootstrap begins next to a map that is still tracked where that one is out of view and does not
  /// explain the images (src/map_coverage.h).
  bool bootstrap_out_of_view = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// All parameters of a run, group by group.
struct OdometryParams {
  SelfCalibrationParams camera;   ///< what the camera file does not say
  EdgeParams edges;               ///< edge detection
  AlignmentParams alignment;      ///< tracking
  AssociationParams association;  ///< matches between keyframes
  MappingParams mapping;          ///< bootstrap, points, window
  KeyframeParams keyframe;        ///< when a frame becomes one; the group `keyframe` of `mapping`
  RecoveryParams recovery;        ///< relocalisation
  EdgeMapParams edge_map;         ///< lines of whole edges

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo

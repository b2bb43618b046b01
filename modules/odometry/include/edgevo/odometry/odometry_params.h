#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/odometry/keyframe_params.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// What is done after a loss.
struct RecoveryParams {
  int max_frames = 10;  ///< relocalisation in the old map is tried in so many frames after a loss, beside a
                        ///< new bootstrap; those that show nothing do not count

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// All parameters of a run, group by group as in params/default.yaml.
struct OdometryParams {
  SelfCalibrationParams camera;   ///< what the camera file does not say
  EdgeParams edges;               ///< edge detection
  AlignmentParams alignment;      ///< tracking
  AssociationParams association;  ///< matches between keyframes
  MappingParams mapping;          ///< bootstrap, points, window
  KeyframeParams keyframe;        ///< when a frame becomes one; the group `keyframe` of `mapping`
  RecoveryParams recovery;        ///< relocalisation
  EdgeMapParams edge_map;         ///< lines of whole edges

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo

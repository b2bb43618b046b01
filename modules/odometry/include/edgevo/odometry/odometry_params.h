#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// What is done after a loss.
struct RecoveryParams {
  /// frames
  int max_frames = 10;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// All parameters of a run, group by group.
struct OdometryParams {
  SelfCalibrationParams camera;   ///< what the camera file does not say
  EdgeParams edges;               ///< edge detection
  AlignmentParams alignment;      ///< tracking
  AssociationParams association;  ///< matches between keyframes
  MappingParams mapping;          ///< bootstrap, points, keyframes, window
  RecoveryParams recovery;        ///< relocalisation
  EdgeMapParams edge_map;         ///< lines of whole edges

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo

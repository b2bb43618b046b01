#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// What is done after a loss, and where one is near.
struct RecoveryParams {
  int max_frames = 10;  ///< relocalisation in the old map is tried in so many frames after a loss, beside a
                        ///< new bootstrap; those that show nothing do not count
  /// A bootstrap begins next to a map that is still tracked where that one is out of view and does not
  /// explain the images (src/map_coverage.h).
  bool bootstrap_out_of_view = true;

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// All parameters of a run, group by group as in params/default.yaml.
struct OdometryParams {
  SelfCalibrationParams camera;   ///< what the camera file does not say
  EdgeParams edges;               ///< edge detection
  AlignmentParams alignment;      ///< tracking
  AssociationParams association;  ///< matches between keyframes
  MappingParams mapping;          ///< bootstrap, points, keyframes, window
  RecoveryParams recovery;        ///< relocalisation
  EdgeMapParams edge_map;         ///< lines of whole edges

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo

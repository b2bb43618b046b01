#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

struct RecoveryParams {
  int max_frames = 10;  ///< that show something: after a loss so many are tried against the old map, beside a new bootstrap

  void visit(ParamVisitor& v);
};

/// All parameters of a run, group by group as in params/default.yaml.
struct OdometryParams {
  SelfCalibrationParams camera;
  EdgeParams edges;
  AlignmentParams alignment;
  AssociationParams association;
  MappingParams mapping;
  RecoveryParams recovery;
  EdgeMapParams edge_map;

  void visit(ParamVisitor& v);
};

}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edge OctoMap as an MRPT metric map: any program that builds maps from an .ini builds it, once the
// plug-in is loaded. share/observations2map_edge_octomap.ini is an example.
//
// It differs from mrpt::maps::COctoMap in what thin, sparse edges need, as modules/occupancy does from
// octomap:
//  - rays stop `carve_stop_sigmas` x `relative_sigma` x range, and a voxel, before their point;
//  - a voxel with a point is not carved by the `protect_scans` scans that follow: a simplemap holds each
//    point once, in its host keyframe, although the keyframes after it saw it, too;
//  - the tree is consistent at all depths, and saved as .bt and .ot under the requested name.
//
// Observations: CObservation3DRangeScan and CObservationPointCloud with 3D points. A point is at robot pose
// (+) sensor pose (+) point, and its ray starts at the sensor.
#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/TMetricMapInitializer.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <string>
#include <unordered_map>
#include <vector>

namespace edgevo {

/// Options of the map; lengths in the unit of the observations.
struct EdgeOctoMapOptions {
  /// Edge length of a voxel.
  double resolution = 0.2;
  /// Largest range of a point from its sensor; farther points are skipped. 0: unlimited.
  double max_range = 0;
  /// Standard deviation of a point's range, relative to it: observations do not state it.
  double relative_sigma = 0.05;
  double carve_stop_sigmas = 3;
  /// Number of scans that may not carve a voxel with a point: a window of keyframes.
  int protect_scans = 7;
  double prob_hit = 0.7, prob_miss = 0.4;

  /// Reads the options of a section. Throws std::runtime_error that names section, key, value and range.
  void load(const mrpt::config::CConfigFileBase& config, const std::string& section);
};

class CEdgeOctoMap : public mrpt::maps::CMetricMap {
  DEFINE_SERIALIZABLE(CEdgeOctoMap, edgevo)

 public:
  explicit CEdgeOctoMap(const EdgeOctoMapOptions& options = {});

  const octomap::OcTree& tree() const { return tree_; }

  bool isEmpty() const override { return tree_.size() == 0; }
  std::string asString() const override;
  /// Writes PREFIX.bt, PREFIX.ot and PREFIX_3D.3Dscene.
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  /// Adds the occupied voxels, coloured by height.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const override;

 protected:
  void internal_clear() override;
  bool internal_insertObservation(const mrpt::obs::CObservation& observation,
                                  const std::optional<const mrpt::poses::CPose3D>& robot_pose) override;
  /// Sum of the log occupancy of the voxels that contain the points.
  double internal_computeObservationLikelihood(const mrpt::obs::CObservation& observation,
                                               const mrpt::poses::CPose3D& taken_from) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& observation) const override;

 private:
  void insert(const octomap::point3d& origin, const std::vector<octomap::point3d>& points);
  void carve(const octomap::point3d& origin, const octomap::point3d& point, octomap::KeySet* free);

  EdgeOctoMapOptions options_;
  octomap::OcTree tree_;
  int scan_ = 0;
  /// Voxels with a point, and the last scan that may not carve them.
  std::unordered_map<octomap::OcTreeKey, int, octomap::OcTreeKey::KeyHash> protected_until_;

  MAP_DEFINITION_START(CEdgeOctoMap)
  EdgeOctoMapOptions options;
  MAP_DEFINITION_END(CEdgeOctoMap)
};

}  // namespace edgevo

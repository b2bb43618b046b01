// SPDX-License-Identifier: BSD-3-Clause
#include "edge_octomap.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

MAP_DEFINITION_REGISTER("edgevo::CEdgeOctoMap,edgeOctoMap", edgevo::CEdgeOctoMap)

namespace edgevo {

IMPLEMENTS_SERIALIZABLE(CEdgeOctoMap, CMetricMap, edgevo)

namespace {

using octomap::OcTreeKey;
using octomap::point3d;

double read_in_range(const mrpt::config::CConfigFileBase& config, const std::string& section,
                     const std::string& key, double value, double least, double most) {
  value = config.read_double(section, key, value);
  if (value >= least && value <= most) return value;
  std::ostringstream text;
  text << "[" << section << "] " << key << " = " << value << " is out of range; write a number from " << least
       << " to " << most;
  throw std::runtime_error(text.str());
}

point3d to_octomap(const mrpt::math::TPoint3D& p) { return {float(p.x), float(p.y), float(p.z)}; }

struct Scan {
  point3d origin;
  std::vector<point3d> points;
};

// Points of an observation in the map; nullopt if its class has none.
std::optional<Scan> scan_of(const mrpt::obs::CObservation& observation,
                            const mrpt::poses::CPose3D& robot_pose) {
  Scan scan;
  mrpt::poses::CPose3D pose = robot_pose;
  const auto add = [&](double x, double y, double z) {
    scan.points.push_back(to_octomap(pose.composePoint({x, y, z})));
  };
  if (const auto* range = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
      range && range->hasPoints3D) {
    pose = robot_pose + range->sensorPose;
    for (size_t i = 0; i < range->points3D_x.size(); ++i)
      add(range->points3D_x[i], range->points3D_y[i], range->points3D_z[i]);
  } else if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
             cloud && cloud->pointcloud) {
    pose = robot_pose + cloud->sensorPose;
    for (size_t i = 0; i < cloud->pointcloud->size(); ++i) {
      double x = 0, y = 0, z = 0;
      cloud->pointcloud->getPoint(i, x, y, z);
      add(x, y, z);
    }
  } else {
    return std::nullopt;
  }
  scan.origin = {float(pose.x()), float(pose.y()), float(pose.z())};
  return scan;
}

octomap::OcTree empty_tree(const EdgeOctoMapOptions& options) {
  octomap::OcTree tree(options.resolution);
  tree.setProbHit(options.prob_hit);
  tree.setProbMiss(options.prob_miss);
  return tree;
}

}  // namespace

void EdgeOctoMapOptions::load(const mrpt::config::CConfigFileBase& config, const std::string& section) {
  const std::string creation = section + "_creationOpts", insertion = section + "_insertOpts";
  resolution = read_in_range(config, creation, "resolution", resolution, 1e-4, 1e4);
  max_range = read_in_range(config, insertion, "max_range", max_range, 0, 1e6);
  relative_sigma = read_in_range(config, insertion, "relative_sigma", relative_sigma, 0, 1);
  carve_stop_sigmas = read_in_range(config, insertion, "carve_stop_sigmas", carve_stop_sigmas, 0, 20);
  protect_scans = int(read_in_range(config, insertion, "protect_scans", protect_scans, 0, 1e6));
  prob_hit = read_in_range(config, insertion, "prob_hit", prob_hit, 0.51, 0.999);
  prob_miss = read_in_range(config, insertion, "prob_miss", prob_miss, 0.001, 0.49);
}

CEdgeOctoMap::TMapDefinition::TMapDefinition() = default;

void CEdgeOctoMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& section) {
  options.load(source, section);
}

void CEdgeOctoMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
  out << "resolution = " << options.resolution << "\nmax_range = " << options.max_range
      << "\nrelative_sigma = " << options.relative_sigma
      << "\ncarve_stop_sigmas = " << options.carve_stop_sigmas
      << "\nprotect_scans = " << options.protect_scans << "\nprob_hit = " << options.prob_hit
      << "\nprob_miss = " << options.prob_miss << "\n";
}

mrpt::maps::CMetricMap* CEdgeOctoMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& definition) {
  return new CEdgeOctoMap(dynamic_cast<const TMapDefinition&>(definition).options);
}

CEdgeOctoMap::CEdgeOctoMap(const EdgeOctoMapOptions& options)
    : options_(options), tree_(empty_tree(options)) {}

std::string CEdgeOctoMap::asString() const {
  std::ostringstream text;
  text << "OctoMap of edges, " << scan_ << " scans, voxels of " << tree_.getResolution();
  return text.str();
}

void CEdgeOctoMap::internal_clear() {
  tree_.clear();
  protected_until_.clear();
  scan_ = 0;
}

bool CEdgeOctoMap::internal_insertObservation(const mrpt::obs::CObservation& observation,
                                              const std::optional<const mrpt::poses::CPose3D>& robot_pose) {
  const auto scan = scan_of(observation, robot_pose.value_or(mrpt::poses::CPose3D()));
  if (!scan) return false;
  insert(scan->origin, scan->points);
  return true;
}

// One scan is one batch, in which occupied wins over free.
void CEdgeOctoMap::insert(const point3d& origin, const std::vector<point3d>& points) {
  octomap::KeySet hit, free;
  for (const point3d& p : points) {
    OcTreeKey key;
    const bool in_range = options_.max_range <= 0 || (p - origin).norm() <= options_.max_range;
    if (!in_range || !tree_.coordToKeyChecked(p, key)) continue;
    hit.insert(key);
    carve(origin, p, &free);
  }
  for (const OcTreeKey& key : hit) {
    tree_.updateNode(key, true);
    protected_until_[key] = scan_ + options_.protect_scans;
  }
  for (const OcTreeKey& key : free) {
    const auto kept = protected_until_.find(key);
    if (kept == protected_until_.end() || kept->second < scan_) tree_.updateNode(key, false);
  }
  ++scan_;
  for (auto it = protected_until_.begin(); it != protected_until_.end();)
    it = it->second < scan_ ? protected_until_.erase(it) : std::next(it);
}

void CEdgeOctoMap::carve(const point3d& origin, const point3d& point, octomap::KeySet* free) {
  const double range = (point - origin).norm();
  const double margin = std::max(options_.carve_stop_sigmas * options_.relative_sigma * range,
                                 std::sqrt(3.0) * tree_.getResolution());
  if (range <= margin) return;
  const point3d end = origin + (point - origin) * float((range - margin) / range);
  OcTreeKey origin_key, end_key;
  // computeRayKeys() would print a warning for ends out of bounds.
  if (!tree_.coordToKeyChecked(origin, origin_key) || !tree_.coordToKeyChecked(end, end_key)) return;
  octomap::KeyRay ray;
  tree_.computeRayKeys(origin, end, ray);
  free->insert(ray.begin(), ray.end());
}

bool CEdgeOctoMap::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& observation) const {
  return scan_of(observation, {}).has_value();
}

double CEdgeOctoMap::internal_computeObservationLikelihood(const mrpt::obs::CObservation& observation,
                                                           const mrpt::poses::CPose3D& taken_from) const {
  const auto scan = scan_of(observation, taken_from);
  double log_likelihood = 0;
  if (!scan) return 0;
  for (const point3d& p : scan->points)
    if (const auto* node = tree_.search(p)) log_likelihood += std::log(node->getOccupancy());
  return log_likelihood;
}

void CEdgeOctoMap::saveMetricMapRepresentationToFile(const std::string& prefix) const {
  octomap::OcTree tree(tree_);  // octomap prunes and simplifies what it writes
  const bool written = tree.write(prefix + ".ot") && tree.writeBinary(prefix + ".bt");
  mrpt::opengl::COpenGLScene scene;
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  getVisualizationInto(*objects);
  scene.insert(objects);
  if (!written || !scene.saveToFile(prefix + "_3D.3Dscene"))
    throw std::runtime_error(prefix + ".bt: cannot be written; free space or give another output prefix");
}

void CEdgeOctoMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const {
  auto voxels = mrpt::opengl::COctoMapVoxels::Create();
  voxels->setVisualizationMode(mrpt::opengl::COctoMapVoxels::COLOR_FROM_HEIGHT);
  voxels->resizeVoxelSets(1);
  double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
  tree_.getMetricMin(x0, y0, z0);
  tree_.getMetricMax(x1, y1, z1);
  voxels->setBoundingBox({x0, y0, z0}, {x1, y1, z1});
  for (auto leaf = tree_.begin_leafs(), end = tree_.end_leafs(); leaf != end; ++leaf) {
    if (!tree_.isNodeOccupied(*leaf)) continue;
    const auto shade = uint8_t(z1 > z0 ? 255 * (leaf.getZ() - z0) / (z1 - z0) : 128);
    voxels->push_back_Voxel(
        0, {mrpt::math::TPoint3Df(float(leaf.getX()), float(leaf.getY()), float(leaf.getZ())), leaf.getSize(),
            mrpt::img::TColor(shade, shade, 255 - shade)});
  }
  out.insert(voxels);
}

uint8_t CEdgeOctoMap::serializeGetVersion() const { return 0; }

void CEdgeOctoMap::serializeTo(mrpt::serialization::CArchive& out) const {
  std::ostringstream nodes;
  tree_.writeData(nodes);
  out << options_.resolution << options_.max_range << options_.relative_sigma << options_.carve_stop_sigmas
      << options_.prob_hit << options_.prob_miss << int32_t(options_.protect_scans) << uint64_t(tree_.size())
      << nodes.str();
}

void CEdgeOctoMap::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0)
    throw std::runtime_error("edgevo::CEdgeOctoMap: written by a newer version of the plug-in; update it");
  int32_t protect_scans = 0;
  uint64_t size = 0;
  std::string nodes;
  in >> options_.resolution >> options_.max_range >> options_.relative_sigma >> options_.carve_stop_sigmas >>
      options_.prob_hit >> options_.prob_miss >> protect_scans >> size >> nodes;
  options_.protect_scans = protect_scans;
  internal_clear();
  tree_.setResolution(options_.resolution);
  tree_.setProbHit(options_.prob_hit);
  tree_.setProbMiss(options_.prob_miss);
  std::istringstream stream(nodes);
  if (size > 0) tree_.readData(stream);
}

}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#include "topics.h"

#include "ros_schemas.h"

namespace edgevo {
namespace {

struct TopicRow {
  Topic topic;
  const char *name, *schema;
  // Whether those that come later get the newest message, too.
  bool is_latched;
};

constexpr TopicRow kTopics[] = {
    {Topic::kTf, "/tf", "tf2_msgs/msg/TFMessage", false},
    {Topic::kTfStatic, "/tf_static", "tf2_msgs/msg/TFMessage", true},
    {Topic::kOdometry, "/edgevo/odometry", "nav_msgs/msg/Odometry", false},
    {Topic::kPose, "/edgevo/pose", "geometry_msgs/msg/PoseStamped", false},
    {Topic::kPoseWithCovariance, "/edgevo/pose_with_covariance",
     "geometry_msgs/msg/PoseWithCovarianceStamped", false},
    {Topic::kPath, "/edgevo/path", "nav_msgs/msg/Path", true},
    {Topic::kPoints, "/edgevo/points", "sensor_msgs/msg/PointCloud2", false},
    {Topic::kEdges, "/edgevo/edges", "visualization_msgs/msg/MarkerArray", false},
    {Topic::kEdgePoints, "/edgevo/edge_points", "sensor_msgs/msg/PointCloud2", false},
    {Topic::kGrid, "/map", "nav_msgs/msg/OccupancyGrid", true},
    {Topic::kCameraInfo, "/edgevo/camera/camera_info", "sensor_msgs/msg/CameraInfo", false},
    {Topic::kImage, "/edgevo/camera/image/compressed", "sensor_msgs/msg/CompressedImage", false},
    {Topic::kLog, "/rosout", "rcl_interfaces/msg/Log", false},
    {Topic::kIsMetric, "/edgevo/is_metric", "std_msgs/msg/Bool", true},
    {Topic::kMapChanges, "/edgevo/map_changes", "std_msgs/msg/UInt32", true},
};

// What rosbag2 plays a latched topic with; it has defaults for the others.
constexpr const char* kLatched =
    "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n"
    "  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false";

}  // namespace

TopicFile::TopicFile(const std::string& path, const std::string& library) : file_(path, library) {
  for (const TopicRow& row : kTopics) {
    file_.add_schema({row.schema, ros_schema(row.schema)});
    file_.add_channel({row.name, row.schema, {{"offered_qos_profiles", row.is_latched ? kLatched : ""}}});
  }
}

}  // namespace edgevo

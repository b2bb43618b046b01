// SPDX-License-Identifier: BSD-3-Clause
// The plug-in as MRPT's programs use it: loaded from its file, its classes created by name.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/TMetricMapInitializer.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>
#include <octomap/OcTree.h>

#include <csignal>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "edgevo/datasets/open_source.h"
#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "support/temp_folder.h"
#include "unit/odometry/hand_source.h"

namespace edgevo {
namespace {

using mrpt::hwdrivers::CGenericSensor;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;
using ::testing::Not;

class Plugin : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(dlopen(EDGEVO_PLUGIN, RTLD_NOW)) << dlerror(); }

  test::TempFolder folder_;
};

// ---- the map ----

class EdgeOctoMap : public Plugin {
 protected:
  static mrpt::maps::CMetricMap::Ptr make(const std::string& creation, const std::string& insertion = "") {
    mrpt::config::CConfigFileMemory ini("[m_creationOpts]\n" + creation + "\n[m_insertOpts]\n" + insertion +
                                        "\n");
    const mrpt::maps::TMetricMapInitializer::Ptr definition(
        mrpt::maps::TMetricMapInitializer::factory("edgeOctoMap"));
    if (!definition) throw std::runtime_error("no such map");
    definition->loadFromConfigFile(ini, "m");
    return mrpt::maps::CMetricMap::Ptr(dynamic_cast<mrpt::maps::CMetricMap*>(
        mrpt::maps::internal::TMetricMapTypesRegistry::Instance().factoryMapObjectFromDefinition(
            *definition)));
  }
  static mrpt::obs::CObservation3DRangeScan scan(const std::vector<Eigen::Vector3f>& points,
                                                 const CPose3D& sensor = {}) {
    mrpt::obs::CObservation3DRangeScan scan;
    scan.sensorPose = sensor;
    scan.hasPoints3D = true;
    for (const auto& p : points) {
      scan.points3D_x.push_back(p.x());
      scan.points3D_y.push_back(p.y());
      scan.points3D_z.push_back(p.z());
    }
    return scan;
  }
  // The octree that planners read.
  octomap::OcTree saved(const mrpt::maps::CMetricMap& map) const {
    map.saveMetricMapRepresentationToFile(folder_ / "map");
    octomap::OcTree tree(0.1);
    if (!tree.readBinary(folder_ / "map.bt")) throw std::runtime_error("map.bt");
    return tree;
  }
  static bool occupied(const octomap::OcTree& tree, double x, double y, double z) {
    const auto* node = tree.search(x, y, z);
    return node && tree.isNodeOccupied(node);
  }
  static bool free(const octomap::OcTree& tree, double x, double y, double z) {
    const auto* node = tree.search(x, y, z);
    return node && !tree.isNodeOccupied(node);
  }
};

TEST_F(EdgeOctoMap, PointsAreOccupiedAndRaysToThemAreFree) {
  const auto map = make("resolution = 0.1");
  EXPECT_TRUE(map->isEmpty());
  ASSERT_TRUE(map->insertObservation(scan({{0, 0, 4.05f}})));
  const octomap::OcTree tree = saved(*map);
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.1);
  EXPECT_TRUE(occupied(tree, 0, 0, 4.05));
  EXPECT_TRUE(free(tree, 0, 0, 1.05));
  EXPECT_TRUE(free(tree, 0, 0, 3.2));     // the ray ends three sigmas (5 % each) before the point
  EXPECT_FALSE(tree.search(0, 0, 3.75));  // unknown
  EXPECT_FALSE(tree.search(0.5, 0, 2));
}

TEST_F(EdgeOctoMap, RobotAndSensorPosesAreApplied) {
  const auto map = make("resolution = 0.1");
  const CPose3D robot(10, 0, 0, M_PI / 2, 0, 0), sensor(1, 0, 2, 0, 0, 0);
  ASSERT_TRUE(map->insertObservation(scan({{3.05f, 0.05f, 0.05f}}, sensor), robot));
  mrpt::obs::CObservationPointCloud cloud;
  const auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(5.05f, 0.05f, 0.05f);
  cloud.pointcloud = points;
  cloud.sensorPose = sensor;
  ASSERT_TRUE(map->insertObservation(cloud, robot));
  const octomap::OcTree tree = saved(*map);
  EXPECT_TRUE(occupied(tree, 10 - 0.05, 4.05, 2.05));  // turned by 90 degrees: x of the robot is y of the map
  EXPECT_TRUE(occupied(tree, 10 - 0.05, 6.05, 2.05));
  EXPECT_TRUE(free(tree, 9.98, 2.05, 2.02));
  EXPECT_FALSE(tree.search(10, 0.5, 2));  // nothing between robot and sensor was seen
}

// A pole is hosted by one keyframe and crossed by the rays of those after it.
TEST_F(EdgeOctoMap, RaysToTheWallDoNotCarveThePole) {
  std::vector<Eigen::Vector3f> pole, wall;
  for (int i = -10; i <= 10; ++i) pole.push_back({0.05f, 0.1f * float(i) + 0.05f, 4.05f});
  for (int i = -30; i <= 30; ++i) wall.push_back({0.05f, 0.1f * float(i) + 0.05f, 8.05f});
  const auto survivors = [&](const std::string& insertion) {
    const auto map = make("resolution = 0.1", insertion);
    map->insertObservation(scan(pole));
    for (int k = 0; k < 6; ++k) map->insertObservation(scan(wall));
    const octomap::OcTree tree = saved(*map);
    int n = 0;
    for (const auto& p : pole) n += occupied(tree, p.x(), p.y(), p.z());
    return n;
  };
  EXPECT_EQ(survivors(""), 21);
  EXPECT_LT(survivors("protect_scans = 0"), 5);
}

TEST_F(EdgeOctoMap, IsUnchangedBySerialisation) {
  const auto map = make("resolution = 0.2", "max_range = 5");
  map->insertObservation(scan({{0, 0, 4}, {1, 0, 9}}));
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << *map;
  memory.Seek(0);
  const auto read = std::dynamic_pointer_cast<mrpt::maps::CMetricMap>(archive.ReadObject());
  ASSERT_TRUE(read);
  const octomap::OcTree a = saved(*map), b = saved(*read);
  EXPECT_TRUE(a == b);
  EXPECT_TRUE(occupied(b, 0, 0, 4));
  EXPECT_FALSE(b.search(1, 0, 9));  // beyond the range
}

TEST_F(EdgeOctoMap, RefusesInvalidInput) {
  try {
    make("resolution = -1");
    FAIL() << "a negative resolution passed";
  } catch (const std::exception& e) {
    EXPECT_THAT(e.what(), HasSubstr("resolution = -1 is out of range"));
  }
  EXPECT_FALSE(make("")->insertObservation(mrpt::obs::CObservationImage()));
}

// ---- the sensor ----

class Sensor : public Plugin {
 protected:
  static CGenericSensor::Ptr load(const std::string& keys) {
    auto sensor = CGenericSensor::createSensorPtr("CEdgeVoSensor");
    if (!sensor) throw std::runtime_error("no such sensor");
    sensor->loadConfig(mrpt::config::CConfigFileMemory("[S]\nprocess_rate = 100\n" + keys), "S");
    return sensor;
  }
  std::string desk(int frames) const {
    SourceOptions options;
    options.path = EDGEVO_TEST_SCENES "/desk";
    options.last = frames;
    import_rawlog(*open_source(options), folder_ / "desk.rawlog");
    return "grabber_type = rawlog\nrawlog_file = " + (folder_ / "desk.rawlog") + "\n";
  }
  // The keys for a video of the desk's first frames, and its calibration.
  std::string video_of_desk(int frames) const {
    const std::string video = folder_ / "desk.avi", desk = EDGEVO_TEST_SCENES "/desk/";
    cv::VideoWriter writer(video, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 20, {640, 480});
    for (int i = 0; i < frames; ++i)
      writer.write(cv::imread(desk + "images/00000" + std::to_string(i) + ".png"));
    return "grabber_type = ffmpeg\nffmpeg_url = " + video + "\ncalibration_file = " + desk + "camera.txt\n";
  }
  // Polls the sensor as rawlog-grabber does, up to `times` times.
  static std::string reason_of_end(CGenericSensor& sensor, int times) {
    try {
      for (int i = 0; i < times; ++i, sensor.getObservations()) sensor.doProcess();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "not ended";
  }
  static std::string why_refused(const std::string& keys) {
    try {
      load(keys)->initialize();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "not refused";
  }
};

// Without setPathForExternalImages, as a user's own program would use it: embedded images, nothing appended
// to any file.
TEST_F(Sensor, DeliversImagePoseAndPoints) {
  const auto sensor = load(desk(40) + "sensorLabel = EYE\n");
  sensor->initialize();
  int images = 0, poses = 0, live = 0, frames = 0, scans = 0;
  size_t points = 0;
  bool ended = false, is_said = false;
  for (int i = 0; i < 60 && !ended; ++i) {
    try {
      sensor->doProcess();
    } catch (const std::exception& e) {
      EXPECT_THAT(e.what(), HasSubstr("[S] end of the input; all 40 frames are in the rawlog"));
      ended = true;
    }
    for (const auto& [time, object] : sensor->getObservations()) {
      if (const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(object)) {
        ++images;
        EXPECT_EQ(image->sensorLabel, "EYE");
        EXPECT_FALSE(image->image.isExternallyStored());
        EXPECT_EQ(image->image.getWidth(), 640u);
        EXPECT_GT(image->cameraParams.fx(), 100);
      }
      if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(object)) {
        poses += pose->sensorLabel == "EDGE_VO", live += pose->sensorLabel == "EDGE_VO_LIVE";
        if (pose->sensorLabel != "EDGE_VO_MAP_ODOM") continue;
        ++frames;
        EXPECT_LT(pose->pose.mean.norm(), 1e-9) << "nothing was found about the past";
      }
      if (const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(object))
        is_said |= comment->text.rfind("EDGE_VO: is_metric false; map_changes 0; unit: arbitrary", 0) == 0;
      if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(object)) {
        ++scans;
        points += scan->points3D_x.size();
        for (float x : scan->points3D_x) ASSERT_GT(x, 0);  // in front: x is forward
      }
    }
  }
  EXPECT_TRUE(ended);
  EXPECT_EQ(images, 40);
  EXPECT_GE(poses, 20);
  EXPECT_EQ(live, poses);
  EXPECT_EQ(frames, 1);
  EXPECT_TRUE(is_said);
  EXPECT_GE(scans, 2);
  EXPECT_GE(points, 200u * size_t(scans));
}

// What the sensor says of the gyro that a rawlog has next to its camera.
TEST_F(Sensor, IsGivenTheGyroOfARawlog) {
  const auto said = [&](const std::vector<GyroSample>& gyro) {
    test::HandSource hand(0, gyro);
    import_rawlog(hand, folder_ / "hand.rawlog");
    const auto sensor = load("grabber_type = rawlog\nrawlog_file = " + (folder_ / "hand.rawlog") + "\n");
    ::testing::internal::CaptureStderr();
    sensor->initialize();
    reason_of_end(*sensor, test::kHandFrames + 5);
    return ::testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(said(test::phone_in_hand()), HasSubstr("gyro: observed, turned by"));
  EXPECT_THAT(said({}), Not(HasSubstr("gyro")));
}

// At the end of a video CCameraSensor returns nothing, forever.
TEST_F(Sensor, EndsWithItsVideo) {
  const auto sensor = load(video_of_desk(8));
  sensor->initialize();
  EXPECT_THAT(reason_of_end(*sensor, 12),
              HasSubstr("[S] grabber_type ffmpeg: no more images (end of the video"));
}

TEST_F(Sensor, EndsAtCtrlC) {
  const auto sensor = load(desk(6) + "at_end = wait\n");
  sensor->initialize();
  EXPECT_EQ(reason_of_end(*sensor, 2), "not ended");
  ASSERT_EQ(std::raise(SIGINT), 0);
  EXPECT_THAT(reason_of_end(*sensor, 2), HasSubstr("[S] interrupted; all 2 frames are in the rawlog"));
}

TEST_F(Sensor, WaitsAtTheEndIfConfigured) {
  const auto sensor = load(desk(2) + "at_end = wait\n");
  sensor->initialize();
  EXPECT_EQ(reason_of_end(*sensor, 6), "not ended");
}

TEST_F(Sensor, ReportsErrorsInOneLine) {
  const std::string rawlog = desk(2);
  EXPECT_THAT(why_refused(rawlog + "detecter = canny\n"),
              HasSubstr("[S] key 'detecter': unknown; did you mean detector?"));
  EXPECT_THAT(why_refused(rawlog + "detector = none_such\n"), HasSubstr("[S] "));
  EXPECT_THAT(why_refused(rawlog + "at_end = stay\n"), HasSubstr("write at_end = stop or wait"));
  EXPECT_THAT(why_refused(rawlog + "max_relative_sigma = 0\n"),
              HasSubstr("max_relative_sigma = 0: out of range"));
  EXPECT_THAT(why_refused(rawlog + "metres_per_unit = -1\n"),
              HasSubstr("metres_per_unit = -1: out of range"));
  const std::string images = "grabber_type = image_dir\nimage_dir_url = " EDGEVO_TEST_SCENES
                             "/desk/images\nleft_format = %06d.png\n";
  EXPECT_THAT(why_refused(images),
              HasSubstr("its calibration: the driver knows none; write calibration_file"));
  EXPECT_THAT(why_refused(rawlog + "params_file = nowhere.yaml\n"), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(why_refused("grabber_type = rawlog\nrawlog_file = nowhere.rawlog\n"),
              HasSubstr("nowhere.rawlog: no such file"));
  EXPECT_THAT(why_refused("grabber_type = rawlog\n"), HasSubstr("rawlog_file is missing"));
  EXPECT_THAT(why_refused("grabber_type = none_such\n"), HasSubstr("the camera does not open"));
}

}  // namespace
}  // namespace edgevo

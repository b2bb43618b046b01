// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/gridmap_writer.h"
#include "rawlog_test_tools.h"
#include "vehicle_track_reader.h"

namespace edgevo {
namespace {

using namespace mrpt::obs;

CObservationOdometry odometry(int i, const std::string& label) {
  CObservationOdometry o;
  o.sensorLabel = label;
  o.timestamp = to_mrpt(test::frame_time(i));
  o.odometry = mrpt::poses::CPose2D(5 + 0.5 * i, 2, 0.1);
  return o;
}

CObservationGPS gps(int i, double latitude, double longitude, int fix_quality) {
  gnss::Message_NMEA_GGA gga;
  gga.fields.latitude_degrees = latitude, gga.fields.longitude_degrees = longitude;
  gga.fields.fix_quality = uint8_t(fix_quality);
  CObservationGPS o;
  o.sensorLabel = "GPS";
  o.timestamp = to_mrpt(test::frame_time(i));
  o.sensorPose = mrpt::poses::CPose3D(-1, 0.5, 2, 0, 0, 0);
  o.setMsg(gga);
  return o;
}

TEST(VehicleTrack, OdometryOfTheRichestSensorButNotOurOwn) {
  const test::TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 10; ++i) {
    writer.write(test::embedded(i));
    writer.write(odometry(i, "EDGE_VO_ODO"));
    if (i < 6) writer.write(odometry(i, "WHEELS"));
    if (i < 2) writer.write(odometry(i, "SPARE"));
  }
  writer.close();
  const VehicleTrack track = read_vehicle_track(folder / "x.rawlog", VehicleSensor::kOdometry);
  ASSERT_EQ(track.positions.size(), 6u);
  EXPECT_EQ(track.positions[3].time, test::frame_time(3));
  EXPECT_LT((track.positions[3].position - Eigen::Vector3d(1.5, 0, 0)).norm(), 1e-9)
      << "the first is the origin";
  EXPECT_EQ(track.sensor_on_vehicle, Eigen::Vector3d::Zero());
  EXPECT_TRUE(read_vehicle_track(folder / "x.rawlog", VehicleSensor::kGps).positions.empty());
}

// A minute of latitude is a nautical mile (1843 m at the equator by WGS84), a minute of longitude 1855 m
// there.
TEST(VehicleTrack, FixesBecomeMetres) {
  const test::TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  writer.write(gps(0, 0, 10, 1));
  writer.write(gps(1, 1 / 60.0, 10, 1));
  writer.write(gps(2, 0, 10 + 1 / 60.0, 1));
  writer.write(gps(3, 40, 40, 0));  // no fix
  writer.write(gps(4, 0, 0, 1));    // nor this, whatever it says
  writer.close();
  const VehicleTrack track = read_vehicle_track(folder / "x.rawlog", VehicleSensor::kGps);
  ASSERT_EQ(track.positions.size(), 3u);
  EXPECT_NEAR(track.positions[1].position.norm(), 1842.9, 0.2);
  EXPECT_NEAR(track.positions[2].position.norm(), 1855.3, 0.2);
  EXPECT_LT((track.sensor_on_vehicle - Eigen::Vector3d(-1, 0.5, 2)).norm(), 1e-9);
}

TEST(VehicleTrack, RobotPosesThroughTheSource) {
  const test::TempFolder folder;
  {
    RawlogWriter writer(folder / "x.rawlog");
    for (int i = 0; i < 3; ++i) {
      writer.write(test::embedded(i));
      CObservationRobotPose o;
      o.sensorLabel = "MOCAP";
      o.timestamp = to_mrpt(test::frame_time(i));
      o.pose.mean = mrpt::poses::CPose3D(1, 2, 3 + i, 0, 0, 0);
      writer.write(o);
    }
    writer.close();
  }
  const auto source = test::open(folder / "x.rawlog");
  const VehicleTrack track = source->vehicle_track(VehicleSensor::kRobotPose);
  ASSERT_EQ(track.positions.size(), 3u);
  EXPECT_NEAR(track.positions[2].position.z(), 2, 1e-9);
  EXPECT_THROW(read_vehicle_track(folder / "none.rawlog", VehicleSensor::kGps), InputError);
}

// The computer's clock is set back by ten seconds between images 4 and 5: the track goes on as the frames do.
TEST(VehicleTrack, FollowsTheClockOfTheImages) {
  const test::TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  const int64_t back = 10 * Timestamp::kTicksPerSecond, half = 333333 / 2;
  for (int i = 0; i < 12; ++i) {
    const auto stated = [&](int64_t ticks) {
      return to_mrpt(Timestamp{test::frame_time(i).ticks + ticks - (i > 4 ? back : 0)});
    };
    auto image = test::embedded(i);
    image.timestamp = stated(0);
    writer.write(image);
    CObservationOdometry o = odometry(i, "WHEELS");
    o.timestamp = stated(half);
    writer.write(o);
  }
  writer.close();
  const auto source = test::open(folder / "x.rawlog");
  const VehicleTrack track = source->vehicle_track(VehicleSensor::kOdometry);
  ASSERT_EQ(track.positions.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(track.positions[size_t(i)].time.ticks, test::frame_time(i).ticks + half) << i;
    EXPECT_NEAR(track.positions[size_t(i)].position.x(), 0.5 * i, 1e-9) << i;
  }
}

TEST(GridmapWriter, MrptReadsTheSameCells) {
  OccupancyGrid grid;
  grid.width = 7, grid.height = 5, grid.resolution = 0.2;
  grid.origin_x = -0.6, grid.origin_y = 1.2;
  grid.cells.assign(35, GridCell::kUnknown);
  grid.cells[2 * 7 + 3] = GridCell::kOccupied;
  grid.cells[4 * 7 + 6] = GridCell::kFree;
  const test::TempFolder folder;
  write_gridmap(grid, folder / "grid.gridmap.gz");
  mrpt::io::CFileGZInputStream file(folder / "grid.gridmap.gz");
  mrpt::maps::COccupancyGridMap2D read;
  mrpt::serialization::archiveFrom(file) >> read;
  const auto at = [&](int x, int y) {
    return read.getPos(float(-0.6 + 0.2 * (x + 0.5)), float(1.2 + 0.2 * (y + 0.5)));
  };
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      const float expected = x == 3 && y == 2 ? 0.01f : x == 6 && y == 4 ? 0.99f : 0.5f;
      EXPECT_NEAR(at(x, y), expected, 0.01) << x << ", " << y;
    }
  EXPECT_THROW(write_gridmap(grid, "/dev/full"), InputError);
}

}  // namespace
}  // namespace edgevo

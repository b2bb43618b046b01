// SPDX-License-Identifier: BSD-3-Clause
// add_vehicle_sensors IN.rawlog TRUTH.txt OUT.rawlog SEED [LATE]: adds wheel odometry, GPS and robot poses to
// a rawlog of images, made from the ground truth of the camera (TUM). Each step of the odometry has 2 % of
// noise, each GPS fix 0.5 m; the robot poses are exact. The odometry is stamped LATE seconds too late. The
// origin of the vehicle is the camera, which looks forward.
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace {

using namespace edgevo;
using namespace mrpt::obs;

// East and north of a point at 43 degrees north as latitude and longitude, by the radii of the Earth there.
CObservationGPS gps_fix(const Eigen::Vector3d& p) {
  constexpr double kLatitude = 43.0, kMeridian = 6365000.0, kParallel = 4672600.0;
  gnss::Message_NMEA_GGA gga;
  gga.fields.latitude_degrees = kLatitude + p.y() / kMeridian * 180 / M_PI;
  gga.fields.longitude_degrees = 6.0 + p.x() / kParallel * 180 / M_PI;
  gga.fields.altitude_meters = 150 + p.z();
  gga.fields.fix_quality = 1;
  CObservationGPS gps;
  gps.sensorLabel = "GPS";
  gps.setMsg(gga);
  return gps;
}

class VehicleSensors {
 public:
  VehicleSensors(const Trajectory& truth, unsigned seed, double late_s) : random_(seed), late_s_(late_s) {
    for (const StampedPose& pose : truth.poses) truth_[pose.time.ticks] = pose.T_world_cam;
  }
  void write(mrpt::Clock::time_point time, RawlogWriter* out) {
    const auto known = truth_.find(from_mrpt(time).ticks);
    if (known == truth_.end()) return;
    const SE3 T_map_vehicle = T_vehicle_cam_forward() * known->second * T_vehicle_cam_forward().inverse();
    const Eigen::Vector3d here = T_map_vehicle.translation();
    odometer_ += (here - last_) * (1 + 0.02 * normal_(random_));
    last_ = here;
    CObservationOdometry odometry;
    odometry.sensorLabel = "WHEELS";
    odometry.odometry = mrpt::poses::CPose2D(odometer_.x(), odometer_.y(), to_mrpt(T_map_vehicle).yaw());
    odometry.hasEncodersInfo = odometry.hasVelocities = false;
    CObservationRobotPose pose;
    pose.sensorLabel = "MOCAP";
    pose.pose.mean = to_mrpt(T_map_vehicle);
    CObservationGPS gps =
        gps_fix(here + 0.5 * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)));
    for (CObservation* o : {static_cast<CObservation*>(&odometry), static_cast<CObservation*>(&pose),
                            static_cast<CObservation*>(&gps)}) {
      o->timestamp = time;
      if (o == &odometry) o->timestamp += mrpt::Clock::duration(int64_t(late_s_ * 1e7));  // 100 ns
      out->write(*o);
    }
  }

 private:
  std::mt19937 random_;
  double late_s_;
  std::normal_distribution<double> normal_;
  std::map<int64_t, SE3> truth_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero(), odometer_ = Eigen::Vector3d::Zero();
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::fprintf(stderr, "usage: add_vehicle_sensors IN.rawlog TRUTH.txt OUT.rawlog SEED [LATE]\n");
    return 2;
  }
  try {
    VehicleSensors sensors(read_trajectory(argv[2]), unsigned(std::stoul(argv[4])),
                           argc > 5 ? std::stod(argv[5]) : 0);
    RawlogReader in(argv[1]);
    RawlogWriter out(argv[3]);
    while (const auto observation = in.next()) {
      out.write(*observation);
      if (IS_CLASS(*observation, CObservationImage)) sensors.write(observation->timestamp, &out);
    }
    out.close();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "add_vehicle_sensors: %s\n", e.what());
    return 2;
  }
}

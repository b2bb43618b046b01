// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry in a thread of its own, between a camera and a ServoFeed.
//
//   ServoFeed feed;
//   ServoOdometry odometry(camera, params, options, &feed);
//   camera thread:  odometry.push(vp_image, time);      servo loop:  feed.pose(now)
//
// Neither thread waits for the odometry. While it is busy, one image waits and is replaced by newer ones.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/core/vpImage.h>
#include <visp3/core/vpRGBa.h>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/time_order.h"
#include "edgevo/core/worker.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_store.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

class KeptMapSearch;

/// The odometry in its own thread, fed by a frame grabber.
class ServoOdometry {
 public:
  /// `feed` must outlive this object. `kept`: the map of an earlier run, of the pinhole that the odometry
  /// works in (read_finished_map(), kept_map/kept_map.h), in which the camera is looked for: ServoPose::cMk.
  /// Null: none. Throws InputError for an unusable camera or detector.
  ServoOdometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
                ServoFeed* feed, std::shared_ptr<const PlaceStore> kept = nullptr);
  ~ServoOdometry();
  ServoOdometry(const ServoOdometry&) = delete;
  ServoOdometry& operator=(const ServoOdometry&) = delete;

  /// From one thread. Adds an image without a copy: let the grabber write into share_with_visp(image), then
  /// move `image` here. An image whose time is not after those before is skipped; after a lasting step back
  /// of the clock its times are shifted (core/time_order.h).
  void push(GrayImage image, Timestamp time);
  /// Adds a copy of a gray image.
  void push(const vpImage<unsigned char>& image, Timestamp time);
  /// Adds a gray copy of a colour image.
  void push(const vpImage<vpRGBa>& image, Timestamp time);

  /// Any thread. Adds a sample of a gyro that is fixed to the camera (Odometry::add_gyro); those up to an
  /// image should come before it.
  void push_gyro(const GyroSample& sample);

  /// Number of waiting images that were replaced by newer ones.
  int replaced() const { return replaced_; }
  /// Waits for the pushed images, ends the thread and returns the run. Call once. After a failure, which the
  /// feed reports too, the run is the part up to there.
  Run finish();

 private:
  // `options` with the events that `kept` needs.
  ServoOdometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
                std::shared_ptr<const PlaceStore> kept, ServoFeed* feed);
  void try_process(Frame frame);
  void add_gyro();
  void process(Frame frame);

  ServoFeed* feed_;
  // Used by the thread only, until it is idle.
  std::unique_ptr<KeptMapSearch> search_;  // null: no kept map; made before the odometry
  Odometry odometry_;
  TimeOrder times_;
  bool has_failed_ = false;
  int next_index_ = 0;  // of the camera's thread
  std::atomic<int> replaced_{0};
  std::mutex gyro_mutex_;        // guards gyro_
  std::deque<GyroSample> gyro_;  // since the frame before
  Worker worker_;                // last member: it ends before the others
};

}  // namespace edgevo

#pragma once
// The odometry in a thread of its own, between a camera and a ServoFeed.
//
//   ServoFeed feed;
//   ServoOdometry odometry(camera, params, options, &feed);
//   camera thread:  odometry.push(vp_image, time);      servo loop:  feed.pose(now)
//
// Neither thread waits for the odometry. An image that comes while the one before is still being worked on
// waits; a third one takes its place: what is newest counts in a loop.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/core/vpImage.h>
#include <visp3/core/vpRGBa.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "edgevo/odometry/odometry.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

/// The odometry, fed by a grabber.
class ServoOdometry {
 public:
  /// `feed` must outlive this. Throws InputError for an unusable camera or detector.
  ServoOdometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
                ServoFeed* feed);
  ~ServoOdometry();
  ServoOdometry(const ServoOdometry&) = delete;
  ServoOdometry& operator=(const ServoOdometry&) = delete;

  /// An image that is handed over, not copied: let the grabber write into share_with_visp(image), then move
  /// `image` here.
  void push(GrayImage image, Timestamp time);
  /// An image that stays with the caller: copied, or turned gray, once.
  void push(const vpImage<unsigned char>& image, Timestamp time);
  void push(const vpImage<vpRGBa>& image, Timestamp time);  ///< likewise

  /// Images whose place a newer one took.
  int replaced() const;
  /// Waits for the images that were pushed, ends the thread and returns the run. Call once. After a failure
  /// (told by the feed, too) it is the part up to there.
  Run finish();

 private:
  void loop();
  void stop();

  ServoFeed* feed_;
  Odometry odometry_;  ///< the thread's, until it has ended
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Frame> waiting_;
  int next_index_ = 0, replaced_ = 0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace edgevo

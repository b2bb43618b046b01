// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/corner_search.h"

#include <chrono>
#include <utility>

#include "edgevo/core/thread_clock.h"
#include "edgevo/core/trace.h"

namespace edgevo {

CornerSearch::CornerSearch(const TrackingParams& params, uint64_t seed)
    : params_(params), random_(Random::derive(seed, 4)) {}

bool CornerSearch::is_busy() const {
  return found_.valid() && found_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

std::shared_future<PoseByCorners> CornerSearch::begin(CornerJob job) {
  found_ = std::async(std::launch::async, [this, job = std::move(job)] {
             name_traced_thread("corners");
             return search(job);
           }).share();
  return found_;
}

PoseByCorners CornerSearch::search(const CornerJob& job) {
  const double start = thread_cpu_ms();
  Track track = add_corners({*job.pyramid, *job.reference, job.motion, job.median_step, job.keyframes,
                             params_, job.rows, false, &random_, false},
                            job.by_edges);
  if (job.rows.is_rolling())
    for (CornerPair& c : track.corners)
      c.to = shift_ray(job.rows.cameras, job.rows.row_time_s, job.rows.expected, job.measured, c.to);
  return {track.result.T_cur_ref, track.result.covariance, std::move(track.corners), thread_cpu_ms() - start};
}

}  // namespace edgevo

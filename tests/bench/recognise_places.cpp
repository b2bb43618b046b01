// SPDX-License-Identifier: BSD-3-Clause
// How well places are recognised: each keyframe of one map is looked up in another one. Writes a CSV with a
// row for each candidate; recognition_table.py adds them up.
//   recognise_places MAP QUERIES [TRAJECTORY]
// MAP, QUERIES: folders of runs, or their map.db. TRAJECTORY: the poses of MAP for the times of both
// (trajectory_tum.txt of MAP, if the queries are the same images in another light): what is right. Without
// one the two are of different places, and nothing is right.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "edgevo/places/place_index.h"
#include "edgevo/places/place_match.h"

namespace {

using namespace edgevo;

constexpr size_t kCandidates = 3;  // as in PlaceMemory

std::string file_of(const std::string& path) {
  return std::filesystem::is_directory(path) ? (std::filesystem::path(path) / kMapFile).string() : path;
}

double median_depth(const std::vector<CloudPoint>& points) {
  std::vector<double> depths;
  for (const CloudPoint& p : points)
    if (p.idepth > 0) depths.push_back(1 / p.idepth);
  return depths.empty() ? 1 : median(std::move(depths));
}

std::optional<SE3> pose_at(const std::vector<StampedPose>& poses, Timestamp time) {
  for (const StampedPose& p : poses)
    if (std::abs(seconds_between(p.time, time)) < 1e-4) return p.T_world_cam;
  return std::nullopt;
}

struct Error {
  double share = -1, degrees = -1;  // of the median depth; -1: not known
};

Error error_of(const SE3& T_a_b, const SE3& truth, double depth) {
  return {(T_a_b.translation() - truth.translation()).norm() / depth,
          deg((T_a_b * truth.inverse()).log().tail<3>().norm())};
}

void recognise(const PlaceStore& map, const PlaceStore& queries, const std::vector<StampedPose>& poses) {
  PlaceIndex index;
  std::vector<size_t> keyframe_of;
  for (size_t i = 0; i < map.size(); ++i)
    if (map.keyframes()[i].view) index.add(*map.keyframes()[i].view), keyframe_of.push_back(i);
  std::printf(
      "query,place,rank,pairs,agreeing,corners,edges,share,share_back,is_proved,by_path_m,by_path_deg,"
      "off,off_deg\n");
  PlaceVotes votes;
  for (size_t q = 0; q < queries.size(); ++q) {
    const StoredKeyframe& query = queries.keyframes()[q];
    if (!query.view) continue;
    const std::optional<SE3> T_map_query = pose_at(poses, query.record->time);
    const PlaceView b{*query.view, queries.points_around(q)};
    int rank = 0;
    for (const int view : index.candidates(*query.view, kCandidates, &votes)) {
      const StoredKeyframe& place = map.keyframes()[keyframe_of[size_t(view)]];
      const PlaceView a{*place.view, map.points_around(keyframe_of[size_t(view)])};
      PlaceEvidence evidence;
      const std::optional<PlaceMatch> match = match_views(map.pinhole(), a, b, &evidence);
      const double depth = median_depth(a.points);
      Error apart, off;
      const std::optional<SE3> T_map_place = pose_at(poses, place.record->time);
      if (T_map_query && T_map_place) {
        const SE3 truth = T_map_place->inverse() * *T_map_query;
        apart = error_of(SE3(), truth, depth);
        if (match) off = error_of(match->T_a_b.rigid, truth, depth);
      }
      std::printf("%d,%d,%d,%d,%d,%.2f,%.2f,%.3f,%.3f,%d,%.4f,%.3f,%.5f,%.4f\n", query.record->frame_index,
                  place.record->frame_index, rank++, evidence.pairs, evidence.agreeing,
                  evidence.corners_log_alarms, evidence.edges_log_alarms, evidence.share[0],
                  evidence.share[1], match ? 1 : 0, apart.share, apart.degrees, off.share, off.degrees);
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) return std::fprintf(stderr, "recognise_places MAP QUERIES [TRAJECTORY]\n"), 2;
  const KeptMap map = read_map(file_of(argv[1])), queries = read_map(file_of(argv[2]));
  recognise(map.store, queries.store, argc > 3 ? read_trajectory(argv[3]).poses : std::vector<StampedPose>());
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}

// SPDX-License-Identifier: BSD-3-Clause
// A map that is written and read back: all that is kept of it, as exactly as stated.
#include <gmock/gmock.h>

#include <filesystem>
#include <map>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/kept_map/map_picture.h"
#include "made_map.h"

namespace edgevo {
namespace {

using test::MadeMap;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void expect_near(const SE3& a, const SE3& b) {
  EXPECT_LT((a.translation() - b.translation()).norm(), 1e-9);
  EXPECT_LT(a.rotation().angularDistance(b.rotation()), 1e-9);
}

void expect_equal_points(const std::vector<EdgePoint>& read, const std::vector<EdgePoint>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (size_t i = 0; i < read.size(); ++i) {
    const EdgePoint &r = read[i], &w = written[i];
    EXPECT_LE((r.px - w.px).cwiseAbs().maxCoeff(), 1 / 32.0 + 1e-5);
    EXPECT_GT(r.normal.dot(w.normal), 0.9999);
    EXPECT_NEAR(r.idepth / w.idepth, 1, 3e-4);
    EXPECT_NEAR(r.idepth_sigma / w.idepth_sigma, 1, 0.025);
    EXPECT_EQ(r.observations, w.observations);
    EXPECT_EQ(r.gray, w.gray);
  }
}

void expect_equal_views(const RememberedView& read, const RememberedView& written) {
  ASSERT_EQ(read.corners.px.size(), written.corners.px.size());
  for (size_t i = 0; i < read.corners.px.size(); ++i)
    EXPECT_LE((read.corners.px[i] - written.corners.px[i]).cwiseAbs().maxCoeff(), 1 / 32.0 + 1e-5);
  EXPECT_EQ(read.corners.descriptors, written.corners.descriptors);
  EXPECT_EQ(read.edges.pinhole, written.edges.pinhole);
  EXPECT_EQ(read.edges.at, written.edges.at);
  EXPECT_EQ(read.edges.normal, written.edges.normal);
  EXPECT_EQ(read.edges.begins, written.edges.begins);
  EXPECT_EQ(read.signature.bits, written.signature.bits);
  EXPECT_EQ(read.light.mean, written.light.mean);
  EXPECT_EQ(read.light.contrast, written.light.contrast);
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

class MapRoundTrip : public ::testing::Test {
 protected:
  test::TempFolder temp_;
  const std::string path_ = temp_ / "map.db";
  MadeMap made_;
};

TEST_F(MapRoundTrip, AFinishedMapIsInTheWorldOfTheRun) {
  made_.run.scale_source = "odometry", made_.run.scale.sigma = 0.01;
  made_.run.camera.applied = {0.01, 0.02, 0.003};
  made_.write(path_);
  const KeptMap map = read_map(path_);
  EXPECT_TRUE(map.is_finished);
  EXPECT_EQ(map.scale_source, "odometry");
  EXPECT_EQ(map.scale_sigma, 0.01);
  EXPECT_EQ(map.correction, made_.run.camera.applied);
  EXPECT_EQ(map.store.pinhole(), made_.header.pinhole);
  EXPECT_EQ(map.header.camera, made_.header.camera);
  EXPECT_EQ(map.header.source, made_.header.source);
  EXPECT_THAT(map.warnings, IsEmpty());
  ASSERT_EQ(map.store.size(), made_.keyframes.size());
  for (size_t i = 0; i < map.store.size(); ++i) {
    const StoredKeyframe& read = map.store.keyframes()[i];
    EXPECT_EQ(read.id, made_.keyframes[i].id);
    EXPECT_EQ(read.epoch, made_.keyframes[i].epoch);
    EXPECT_EQ(read.record->frame_index, made_.run.keyframes[i].frame_index);
    EXPECT_EQ(read.record->time, made_.run.keyframes[i].time);
    EXPECT_EQ(read.record->segment, made_.run.keyframes[i].segment);
    expect_near(read.record->T_world_cam, made_.run.keyframes[i].T_world_cam);
    expect_equal_points(read.record->points, made_.run.keyframes[i].points);
    expect_equal_views(*read.view, *made_.keyframes[i].view);
  }
}

// What relates keyframes has the unit of the poses.
TEST_F(MapRoundTrip, RelationsGrowWithTheUnit) {
  made_.write(path_);
  const KeptMap map = read_map(path_);
  const std::vector<StoredKeyframe>& k = map.store.keyframes();
  for (size_t i = 0; i + 1 < k.size(); ++i) {
    ASSERT_TRUE(k[i].next);
    EXPECT_EQ(k[i].next->id, k[i + 1].id);
    expect_near(k[i].next->T_leaving_neighbour, map.store.T_a_b(i, i + 1));
    EXPECT_NEAR(k[i].next->covariance(0, 0), 1e-4 * MadeMap::kGrowth * MadeMap::kGrowth, 1e-6);
    EXPECT_NEAR(k[i].next->covariance(4, 4), 1e-4, 1e-8);
  }
  ASSERT_EQ(map.constraints.size(), 1u);
  const Constraint& c = map.constraints.front();
  EXPECT_EQ(c.kind, ConstraintKind::kPlace);
  EXPECT_NEAR(c.T_from_to.scale, 1, 1e-3);
  EXPECT_LT((c.T_from_to.rigid.translation() - map.store.T_a_b(1, 5).translation()).norm(), 2e-3);
}

TEST_F(MapRoundTrip, AnInterruptedMapIsInTheMapsOfItsSegments) {
  {
    MapFileWriter writer(path_, made_.header);
    made_.write(&writer);
  }
  const KeptMap map = read_map(path_);
  EXPECT_FALSE(map.is_finished);
  EXPECT_THAT(map.warnings, ElementsAre(HasSubstr("edgevo finish")));
  ASSERT_EQ(map.store.size(), made_.keyframes.size());
  for (size_t i = 0; i < map.store.size(); ++i)
    expect_near(map.store.keyframes()[i].record->T_world_cam, made_.keyframes[i].record->T_world_cam);
}

TEST_F(MapRoundTrip, WhatTurnsOutDoubtfulIsRemoved) {
  {
    MapFileWriter writer(path_, made_.header);
    made_.write(&writer);
    StoredKeyframe k = made_.keyframes[2];
    auto doubtful = std::make_shared<KeyframeRecord>(*k.record);
    doubtful->is_doubtful = true;
    k.record = doubtful;
    writer.add(k);
  }
  const KeptMap map = read_map(path_);
  ASSERT_EQ(map.store.size(), made_.keyframes.size() - 1);
  for (const StoredKeyframe& k : map.store.keyframes()) EXPECT_NE(k.id, made_.keyframes[2].id);
}

TEST_F(MapRoundTrip, WhatIsDoubtfulOrHasNoViewIsNotKept) {
  auto doubtful = std::make_shared<KeyframeRecord>(*made_.keyframes[2].record);
  doubtful->is_doubtful = true;
  made_.keyframes[2].record = doubtful;
  made_.keyframes[3].view = nullptr;
  made_.run.keyframes[4].is_doubtful = true;  // which shows later
  made_.write(path_);
  std::vector<int> ids;
  const KeptMap map = read_map(path_);
  for (const StoredKeyframe& k : map.store.keyframes()) ids.push_back(k.id);
  EXPECT_EQ(ids.size(), made_.keyframes.size() - 3);
  EXPECT_THAT(std::vector<int>(ids.begin(), ids.begin() + 3), ElementsAre(0, 2, 10));
}

TEST_F(MapRoundTrip, ConstraintsThatDoNotHoldAreNotKept) {
  {
    MapFileWriter writer(path_, made_.header);
    made_.write(&writer);
    for (int i = 0; i < 4; ++i) writer.add(made_.place(i, size_t(i), size_t(i) + 8));
    writer.withdraw(1);
    ConstraintRecord contradicted;
    contradicted.kind = to_string(ConstraintKind::kPlace);
    contradicted.from_frame = made_.run.keyframes[2].frame_index;
    contradicted.to_frame = made_.run.keyframes[10].frame_index;
    contradicted.holds = false;
    made_.run.constraints.push_back(contradicted);
    writer.finish(made_.run);
  }
  std::vector<int> from;
  for (const Constraint& c : read_map(path_).constraints) from.push_back(c.from.number());
  EXPECT_THAT(from, ElementsAre(MadeMap::id_of(0), MadeMap::id_of(3)));
}

TEST_F(MapRoundTrip, AViewThatMovedReplacesTheOneBefore) {
  MapFileWriter writer(path_, made_.header);
  made_.write(&writer);
  auto moved = std::make_shared<RememberedView>(*made_.keyframes[1].view);
  for (Eigen::Vector2f& px : moved->corners.px) px.x() += 1;
  made_.keyframes[1].view = moved;
  writer.add(made_.keyframes[1]);
  writer.finish(made_.run);
  const KeptMap map = read_map(path_);
  ASSERT_EQ(map.store.size(), made_.keyframes.size());
  expect_equal_views(*map.store.keyframes()[1].view, *moved);
}

TEST_F(MapRoundTrip, EqualRunsGiveEqualBytesInOneFile) {
  made_.write(path_);
  EXPECT_THAT(names_in(temp_.path()), ElementsAre("map.db"));
  test::TempFolder other;
  made_.write(other / "map.db");
  EXPECT_TRUE(read_file(path_, "") == read_file(other / "map.db", ""));
}

// A map that was finished already, by a run that was killed while it wrote its other files.
TEST_F(MapRoundTrip, FinishedTwiceItIsTheSame) {
  made_.write(path_);
  const std::string once = read_file(path_, "");
  MapFileWriter(path_).finish(made_.run);
  EXPECT_TRUE(read_file(path_, "") == once);
}

TEST_F(MapRoundTrip, AMapWithoutKeyframes) {
  made_.keyframes.clear();
  MapFileWriter(path_, made_.header).finish(made_.run);
  const KeptMap map = read_map(path_);
  EXPECT_EQ(map.store.size(), 0u);
  EXPECT_THAT(map.warnings, IsEmpty());
  EXPECT_GT(describe(map, path_).size(), 5u);
  EXPECT_GT(map_picture(map).size(), 100u);
}

TEST_F(MapRoundTrip, IsDescribedAndDrawn) {
  made_.write(path_);
  const KeptMap map = read_map(path_);
  std::map<std::string, std::string> lines;
  for (const auto& [name, value] : describe(map, path_)) lines[name] = value;
  EXPECT_THAT(lines["keyframes"], HasSubstr(std::to_string(map.store.size()) + " in 2 segments"));
  EXPECT_THAT(lines["constraints"], HasSubstr("1 places seen again"));
  EXPECT_THAT(lines["unit"], HasSubstr("arbitrary"));
  EXPECT_THAT(lines["camera"], "a camera");
  EXPECT_THAT(map_picture(map), HasSubstr("PNG"));
}

// 400 corners, 6,000 pixels of edges, 1,000 points: as a drive at 1241x376.
TEST_F(MapRoundTrip, AKeyframeTakesAtMostFortyKilobytes) {
  const MadeMap large(90, 1000, 400, 200);
  large.write(path_);
  const double bytes = double(std::filesystem::file_size(path_)) / double(large.keyframes.size());
  RecordProperty("bytes", std::to_string(bytes));
  EXPECT_LT(bytes, 40e3);
}

}  // namespace
}  // namespace edgevo

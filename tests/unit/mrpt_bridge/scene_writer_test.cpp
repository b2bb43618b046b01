// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/scene_writer.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/CCamera.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>

#include "edgevo/core/error.h"
#include "playback_test_run.h"

namespace edgevo {
namespace {

class SceneWriter : public test::FolderTest {
 protected:
  mrpt::opengl::COpenGLScene written(const edgevo::Run& run, const SceneOptions& options = {}) const {
    write_scene(run, PointFilter(), path("scene.3Dscene"), options);
    mrpt::opengl::COpenGLScene scene;
    EXPECT_TRUE(scene.loadFromFile(path("scene.3Dscene")));
    return scene;
  }
  template <class T>
  static std::shared_ptr<T> object(mrpt::opengl::COpenGLScene& scene, const std::string& name) {
    return std::dynamic_pointer_cast<T>(scene.getByName(name));
  }
};

TEST_F(SceneWriter, HoldsTrajectoryKeyframesAndEdges) {
  auto scene = written(test::small_run());
  const auto trajectory = object<mrpt::opengl::CSetOfLines>(scene, "trajectory 0");
  const auto keyframes = object<mrpt::opengl::CSetOfLines>(scene, "keyframes");
  const auto edges = object<mrpt::opengl::CPointCloudColoured>(scene, "edges");
  ASSERT_TRUE(trajectory && keyframes && edges);
  EXPECT_EQ(trajectory->size(), 6u);  // seven poses
  EXPECT_EQ(keyframes->size(), 3u * 8);
  ASSERT_EQ(edges->size(), 15u);
  const auto p = edges->getPoint3Df(1);
  EXPECT_NEAR(p.x, 7, 1e-4);      // forward
  EXPECT_NEAR(p.y, -0.5, 1e-4);   // left
  EXPECT_NEAR(p.z, -0.25, 1e-4);  // up
}

// Path, frusta and lines share one world, that of the map: x forward, y left, z up.
TEST_F(SceneWriter, PathLinesAndEdgesShareOneWorld) {
  edgevo::Run run = test::small_run();
  EdgeLine line;
  for (const Eigen::Vector3d& p_world : {Eigen::Vector3d(-2, 1, 11), Eigen::Vector3d(1.5, -1, 9)}) {
    const EdgePoint p = test::edge_point(run.pinhole, run.keyframes[1].T_world_cam, p_world);
    line.vertices.push_back({p.px, p.idepth, p.idepth_sigma, 40, 200});
  }
  run.keyframes[1].lines = {line};
  auto scene = written(run);
  const auto box_of = [&](const std::string& name) {
    const auto lines = object<mrpt::opengl::CSetOfLines>(scene, name);
    EXPECT_TRUE(lines) << name;
    return lines ? lines->getBoundingBox() : mrpt::math::TBoundingBox();
  };
  const auto path = box_of("trajectory 0");  // from the origin by (0.02, -0.01, 0.3) a frame, camera axes
  EXPECT_NEAR(path.max.x, 0.3 * 7, 1e-5);
  EXPECT_NEAR(path.min.y, -0.02 * 7, 1e-5);
  EXPECT_NEAR(path.max.z, 0.01 * 7, 1e-5);
  EXPECT_NEAR(path.min.x, 0, 1e-5);
  std::string band;
  for (int b = 0; b < 16; ++b)
    if (const std::string name = "edge lines " + std::to_string(b); scene.getByName(name)) band = name;
  const auto edges = box_of(band);
  EXPECT_NEAR(edges.min.x, 9, 1e-4);
  EXPECT_NEAR(edges.max.x, 11, 1e-4);
  EXPECT_NEAR(edges.min.y, -1.5, 1e-4);
  EXPECT_NEAR(edges.max.y, 2, 1e-4);
  EXPECT_NEAR(edges.min.z, -1, 1e-4);
  EXPECT_NEAR(edges.max.z, 1, 1e-4);
}

TEST_F(SceneWriter, SegmentsAreNotJoinedByALine) {
  edgevo::Run run = test::small_run();
  for (size_t i = 4; i < run.frames.size(); ++i) run.frames[i].segment = 1;
  auto scene = written(run);
  EXPECT_EQ(object<mrpt::opengl::CSetOfLines>(scene, "trajectory 0")->size(), 2u);
  EXPECT_EQ(object<mrpt::opengl::CSetOfLines>(scene, "trajectory 1")->size(), 3u);
}

TEST_F(SceneWriter, ManyPointsAreThinnedOut) {
  SceneOptions options;
  options.max_points = 4;
  auto scene = written(test::small_run(), options);
  EXPECT_EQ(object<mrpt::opengl::CPointCloudColoured>(scene, "edges")->size(), 4u);
}

// In any unit, the whole scene is in front of its camera and fills the view.
TEST_F(SceneWriter, CameraSeesTheWholeScene) {
  for (const double unit : {0.01, 1.0, 300.0}) {
    edgevo::Run run = test::small_run();
    for (auto& frame : run.frames)
      if (frame.T_world_cam)
        frame.T_world_cam = SE3(frame.T_world_cam->rotation(), unit * frame.T_world_cam->translation());
    for (auto& k : run.keyframes) {
      k.T_world_cam = SE3(k.T_world_cam.rotation(), unit * k.T_world_cam.translation());
      for (auto& p : k.points) p.idepth = float(p.idepth / unit);
    }
    auto scene = written(run);
    EXPECT_TRUE(scene.followCamera());  // SceneViewer3D keeps its own view otherwise
    const mrpt::opengl::CCamera& camera = scene.getViewport()->getCamera();
    const auto box = object<mrpt::opengl::CSetOfLines>(scene, "trajectory 0")->getBoundingBox();
    const double far = (box.max - box.min).norm();
    EXPECT_GT(camera.getZoomDistance(), 0.9 * far);
    EXPECT_LT(camera.getZoomDistance(), 20 * far);
    const mrpt::math::TPoint3D aim(camera.getPointingAtX(), camera.getPointingAtY(), camera.getPointingAtZ());
    EXPECT_LT((0.5 * (box.max + box.min) - aim).norm(), 0.6 * camera.getZoomDistance());
  }
}

TEST_F(SceneWriter, EmptyRunGivesAScene) {
  auto scene = written(edgevo::Run());
  EXPECT_EQ(object<mrpt::opengl::CPointCloudColoured>(scene, "edges")->size(), 0u);
}

TEST_F(SceneWriter, FullDiskIsReported) {
  EXPECT_THROW(write_scene(test::small_run(), PointFilter(), "/dev/full"), InputError);
}

}  // namespace
}  // namespace edgevo

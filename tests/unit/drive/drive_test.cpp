#include "edgevo/drive/drive.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "edgevo/core/bad_frame.h"

namespace edgevo {
namespace {

// Blank images, a hundred of them; or as many as it gives before it breaks. Those of `bad` cannot be used.
class BlankSource : public ImageSource {
 public:
  explicit BlankSource(int breaks_at = -1, std::set<int> bad = {})
      : breaks_at_(breaks_at), bad_(std::move(bad)) {
    camera_.pinhole = {50, 50, 32, 24, 64, 48};
  }

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return 100; }
  std::string kind() const override { return "blank"; }
  std::optional<SE3> T_vehicle_cam() const override {
    return SE3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
  }
  std::optional<Frame> next() override {
    if (given_ == breaks_at_) throw std::runtime_error("the cable");
    if (given_ == 100) return std::nullopt;
    const int index = given_++;
    if (bad_.count(index))
      throw BadFrame(index, Timestamp::from_seconds(0.1 * index),
                     InputError("an image", "is torn", "mend it"));
    return Frame{index, Timestamp::from_seconds(0.1 * index),
                 GrayImage{64, 48, std::vector<uint8_t>(64 * 48, 90)}};
  }

 private:
  Camera camera_;
  int breaks_at_, given_ = 0;
  std::set<int> bad_;
};

bool go_on(const DrivenFrame&) { return true; }

TEST(Drive, GoesToTheEndOfTheSource) {
  BlankSource source;
  int seen = 0;
  const Drive driven = drive(source, {}, {}, [&](const DrivenFrame& f) {
    EXPECT_EQ(f.frame.index, seen);
    EXPECT_EQ(f.record.index, seen++);
    return true;
  });
  EXPECT_EQ(seen, 100);
  EXPECT_EQ(driven.run.frames.size(), 100u);
  EXPECT_FALSE(driven.broken);
  ASSERT_TRUE(driven.run.T_vehicle_cam);
  EXPECT_EQ(driven.run.T_vehicle_cam->translation().z(), 1.5);
}

TEST(Drive, EndsWhenTheCallerHasSeenEnough) {
  BlankSource source;
  EXPECT_EQ(drive(source, {}, {}, [](const DrivenFrame& f) { return f.frame.index < 9; }).run.frames.size(),
            10u);
}

TEST(Drive, EndsWhenToldToStop) {
  BlankSource source;
  DriveOptions options;
  options.stop = [asked = 0]() mutable { return asked++ == 7; };
  EXPECT_EQ(drive(source, {}, options, go_on).run.frames.size(), 7u);
}

TEST(Drive, KeepsWhatWasThereBeforeTheSourceBroke) {
  for (const bool realtime : {false, true}) {
    BlankSource source(12);
    DriveOptions options;
    options.odometry.realtime = realtime;
    const Drive driven = drive(source, {}, options, go_on);
    EXPECT_EQ(driven.run.frames.size(), 12u);
    EXPECT_EQ(driven.run.realtime.has_value(), realtime);
    ASSERT_TRUE(driven.broken);
    EXPECT_THROW(std::rethrow_exception(driven.broken), std::runtime_error);
  }
}

TEST(Drive, LeavesBadFramesOutAndSaysSo) {
  for (const bool realtime : {false, true}) {
    BlankSource source(-1, {7, 8, 40});
    DriveOptions options;
    options.odometry.realtime = realtime;
    options.on_bad_frame = OnBadFrame::kSkip;
    int without_image = 0;
    const Drive driven = drive(source, {}, options, [&](const DrivenFrame& f) {
      without_image += f.frame.image.empty();
      return true;
    });
    EXPECT_FALSE(driven.broken);
    EXPECT_EQ(without_image, 3);
    EXPECT_EQ(driven.left_out, 3);
    EXPECT_EQ(driven.first_left_out, "an image: is torn");
    ASSERT_EQ(driven.run.frames.size(), 100u);
    EXPECT_EQ(driven.run.frames[40].index, 40);
    EXPECT_EQ(driven.run.frames[40].note, "left out: an image: is torn");
    EXPECT_EQ(driven.run.frames[40].latency_ms.has_value(), false);
    EXPECT_EQ(driven.run.frames[41].latency_ms.has_value(), realtime);
  }
}

TEST(Drive, ABadFrameEndsItWhereThatIsAsked) {
  BlankSource source(-1, {12});
  const Drive driven = drive(source, {}, {}, go_on);
  EXPECT_EQ(driven.run.frames.size(), 12u);
  ASSERT_TRUE(driven.broken);
  EXPECT_THROW(std::rethrow_exception(driven.broken), BadFrame);
}

TEST(Drive, ABadFirstFrameMeansAWrongSource) {
  BlankSource source(-1, {0});
  DriveOptions options;
  options.on_bad_frame = OnBadFrame::kSkip;
  const Drive driven = drive(source, {}, options, go_on);
  EXPECT_TRUE(driven.run.frames.empty());
  EXPECT_TRUE(driven.broken);
}

}  // namespace
}  // namespace edgevo

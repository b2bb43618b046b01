// SPDX-License-Identifier: BSD-3-Clause
// A folder and the rawlog made from it give the same frames, bit for bit.
#include "edgevo/datasets/open_source.h"
#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::TempFolder;

SourceOptions imported_source(const std::string& path) {
  SourceOptions options;
  options.path = path;
  return options;
}

void expect_same_camera(const Camera& a, const Camera& b) {
  const Pinhole p = a.pinhole(), q = b.pinhole();
  const Distortion d = a.distortion(), e = b.distortion();
  EXPECT_TRUE(p.fx == q.fx && p.fy == q.fy && p.cx == q.cx && p.cy == q.cy && p.width == q.width &&
              p.height == q.height);
  EXPECT_TRUE(d.k1 == e.k1 && d.k2 == e.k2 && d.p1 == e.p1 && d.p2 == e.p2 && d.k3 == e.k3);
}

// Reads both in step; returns the number of frames.
int expect_same_frames(ImageSource& a, ImageSource& b) {
  int count = 0;
  while (true) {
    const auto x = a.next(), y = b.next();
    EXPECT_EQ(x.has_value(), y.has_value()) << "one ends early at frame " << count;
    if (!x || !y) return count;
    EXPECT_EQ(x->index, y->index);
    EXPECT_EQ(x->time.ticks, y->time.ticks);
    EXPECT_TRUE(test::same_pixels(x->image, y->image)) << "frame " << count;
    ++count;
  }
}

TEST(Import, RoundTripIsExact) {
  TempFolder folder;
  test::write_edgevo_layout(folder / "seq", 5);
  EXPECT_EQ(import_rawlog(*open_source(imported_source(folder / "seq")), folder / "seq.rawlog"), 5);
  const auto original = open_source(imported_source(folder / "seq")),
             imported = open_source(imported_source(folder / "seq.rawlog"));
  EXPECT_EQ(imported->label(), "CAM0");
  EXPECT_EQ(imported->times().size(), 5u);
  expect_same_camera(original->camera(), imported->camera());
  EXPECT_EQ(expect_same_frames(*original, *imported), 5);
}

TEST(Import, IsRepeatable) {
  TempFolder folder;
  test::write_edgevo_layout(folder / "seq", 3);
  import_rawlog(*open_source(imported_source(folder / "seq")), folder / "a.rawlog");
  import_rawlog(*open_source(imported_source(folder / "seq")), folder / "b.rawlog");
  EXPECT_EQ(test::read_text(folder / "a.rawlog"), test::read_text(folder / "b.rawlog"));
}

// Three frames, read from files of one name in different folders.
class SameNames : public ImageSource {
 public:
  explicit SameNames(Camera camera) : camera_(std::move(camera)) {}
  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return 3; }
  std::string kind() const override { return "test"; }
  std::optional<Frame> next() override {
    if (index_ == 3) return std::nullopt;
    const int w = camera_.pinhole().width, h = camera_.pinhole().height, i = index_++;
    return Frame{i,
                 Timestamp::from_seconds(i),
                 {w, h, std::vector<uint8_t>(size_t(w) * h, uint8_t(i))},
                 "/" + std::to_string(i) + "/left.png"};
  }

 private:
  Camera camera_;
  int index_ = 0;
};

TEST(Import, ImagesOfOneNameDoNotOverwriteEachOther) {
  TempFolder folder;
  test::write_edgevo_layout(folder / "seq", 1);
  const Camera camera = open_source(imported_source(folder / "seq"))->camera();
  SameNames frames(camera), again(camera);
  EXPECT_EQ(import_rawlog(frames, folder / "x.rawlog"), 3);
  EXPECT_EQ(expect_same_frames(again, *open_source(imported_source(folder / "x.rawlog"))), 3);
}

TEST(Import, KeepsTheFramesBeforeABadOne) {
  TempFolder folder;
  test::write_edgevo_layout(folder / "seq", 4);
  test::write_text(folder / "seq/images/000002.png", "broken");
  EXPECT_NE(test::error_of(
                [&] { import_rawlog(*open_source(imported_source(folder / "seq")), folder / "x.rawlog"); }),
            "");
  EXPECT_EQ(test::read_all(*open_source(imported_source(folder / "x.rawlog"))).size(), 2u);
}

TEST(Import, RealSequence) {
  for (const char* name : {"kitti00_first300", "tum_fr1_xyz_first500"}) {
    const std::string path = test::real_sequence(name);
    if (path.empty())
      GTEST_SKIP() << "NOT TESTED: no folder " << name << " under ../shared/data or EDGEVO_DATA";
    TempFolder folder;
    SourceOptions options = imported_source(path);
    set_frame_range("0:40", &options);
    import_rawlog(*open_source(options), folder / "x.rawlog");
    const auto original = open_source(options), imported = open_source(imported_source(folder / "x.rawlog"));
    expect_same_camera(original->camera(), imported->camera());
    EXPECT_EQ(expect_same_frames(*original, *imported), 40) << name;
  }
}

}  // namespace
}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
// Maps that are damaged, of another kind or of another camera: one clear line, and the rest is used. And
// those of a program that is killed.
#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "made_map.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::MadeMap;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

void execute(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

// Names and bytes of all files.
std::map<std::string, std::string> contents_of(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] = read_file(entry.path().string(), "");
  return files;
}

class DamagedMap : public ::testing::Test {
 protected:
  void SetUp() override { made_.write(path_); }
  std::string message() const {
    return message_of([&] { read_map(path_); });
  }

  test::TempFolder temp_;
  const std::string path_ = temp_ / "map.db";
  const MadeMap made_;
};

TEST_F(DamagedMap, NothingThatIsAMap) {
  EXPECT_THAT(message_of([&] { read_map(temp_ / "none.db"); }), HasSubstr("none.db: cannot be read"));
  EXPECT_THAT(message_of([&] { read_map(temp_.path()); }), HasSubstr(temp_.path()));
  write_file(path_, "");
  EXPECT_THAT(message(), HasSubstr("map.db: is empty; give the folder of a run, or its map.db"));
  write_file(path_, "text");
  EXPECT_THAT(message(), HasSubstr("map.db: is no map; give"));
  fs::remove(path_);
  execute(path_, "CREATE TABLE cameras(id)");
  EXPECT_THAT(message(), HasSubstr("map.db: is a database of something else; give"));
}

TEST_F(DamagedMap, OneWithoutAKeyframeIsOfNoUse) {
  execute(path_, "DELETE FROM keyframes");
  EXPECT_THAT(message_of([&] { read_finished_map(path_); }),
              HasSubstr("map.db: has no keyframe that can be read: it is damaged, cut off or empty; give"));
}

TEST_F(DamagedMap, NewerVersionsAreRefused) {
  execute(path_, "PRAGMA user_version=7");
  EXPECT_THAT(message(), HasSubstr("map.db: is a map of version 7, this edgevo reads up to 1; read it with"));
}

TEST_F(DamagedMap, AnotherCameraIsRefused) {
  const KeptMap map = read_map(path_);
  Pinhole pinhole = made_.header.pinhole;
  pinhole.fx *= 1.01;
  check_camera(map, pinhole, path_);
  pinhole.fx *= 1.05;
  EXPECT_THAT(
      message_of([&] { check_camera(map, pinhole, path_); }),
      AllOf(HasSubstr("map.db: was made by another camera"), HasSubstr("; give a map of this camera")));
}

TEST_F(DamagedMap, ADamagedRowCostsThatRow) {
  execute(path_, "UPDATE keyframes SET view = CAST(substr(view, 1, 500) AS BLOB) WHERE id = 4");
  execute(path_, "UPDATE keyframes SET place = x'00' WHERE id = 8");
  execute(path_, "UPDATE keyframes SET id = 7 WHERE id = 6");
  const KeptMap map = read_map(path_);
  EXPECT_EQ(map.store.size(), made_.keyframes.size() - 3);
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_THAT(map.warnings.front(), HasSubstr("map.db: 3 keyframes are damaged, the other " +
                                              std::to_string(map.store.size()) + " are used"));
}

TEST_F(DamagedMap, ADamagedRelationCostsThatRelation) {
  execute(path_, "UPDATE constraints SET data = x'0011' WHERE number = 0 OR number = -3");
  const KeptMap map = read_map(path_);
  EXPECT_EQ(map.store.size(), made_.keyframes.size());
  EXPECT_FALSE(map.store.keyframes()[1].next);
  EXPECT_TRUE(map.constraints.empty());
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_THAT(map.warnings.front(), HasSubstr("2 relations of keyframes are damaged"));
}

TEST_F(DamagedMap, ADamagedDescriptionIsRefused) {
  execute(path_, "UPDATE meta SET text = '1 2 3 4 5 6' WHERE name = 'pinhole'");
  EXPECT_THAT(message(), HasSubstr("map.db: its description is damaged; record"));
}

// Whatever is missing at its end: what is read is what was written, and something is said.
TEST_F(DamagedMap, TruncatedFilesAreReadAsFarAsTheyGo) {
  const std::string whole = read_file(path_, "");
  Random random(3);
  size_t most = 0;
  for (int i = 0; i < 60; ++i) {
    write_file(path_, whole.substr(0, size_t(random.below(int(whole.size())))));
    try {
      const KeptMap map = read_map(path_);
      EXPECT_FALSE(map.warnings.empty());
      most = std::max(most, map.store.size());
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
  EXPECT_GT(most, made_.keyframes.size() / 2);
}

// A keyframe that is read is one that was written.
TEST_F(DamagedMap, FlippedBitsNeverGiveAnotherKeyframe) {
  const std::string whole = read_file(path_, "");
  Random random(4);
  int refused = 0;
  size_t read = 0;
  for (int i = 0; i < 200; ++i) {
    std::string bytes = whole;
    char& flipped = bytes[size_t(random.below(int(bytes.size())))];
    flipped = char(flipped ^ 1 << random.below(8));
    write_file(path_, bytes);
    try {
      const KeptMap map = read_map(path_);
      read += map.store.size();
      for (const StoredKeyframe& k : map.store.keyframes()) {
        const StoredKeyframe& written = made_.keyframes[size_t(k.id / 2)];
        EXPECT_EQ(k.id, written.id);
        EXPECT_EQ(k.record->time, written.record->time);
        EXPECT_EQ(k.view->edges.at, written.view->edges.at);
        EXPECT_EQ(k.view->corners.descriptors, written.view->corners.descriptors);
      }
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_LT(refused, 10);
  EXPECT_GT(read, 190 * (made_.keyframes.size() - 3));
}

TEST_F(DamagedMap, ReadingChangesNothing) {
  const auto before = contents_of(temp_.path());
  read_map(path_);
  EXPECT_TRUE(contents_of(temp_.path()) == before);
  fs::permissions(temp_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(read_map(path_).store.size(), made_.keyframes.size());
  fs::permissions(temp_.path(), fs::perms::owner_all);
}

// Writes keyframes without end, and the number of those written into a pipe.
[[noreturn]] void write_until_killed(const MadeMap& made, const std::string& path, int pipe) {
  MapFileWriter writer(path, made.header);
  for (int id = 0;; ++id) {
    StoredKeyframe k = made.keyframes[size_t(id) % made.keyframes.size()];
    k.id = id;
    writer.add(k);
    if (write(pipe, &id, sizeof id) != sizeof id) _exit(1);
  }
}

TEST_F(DamagedMap, AWriterThatIsKilledLeavesItsKeyframes) {
  Random random(7);
  size_t read = 0;
  for (int i = 0; i < 20; ++i) {
    fs::remove(path_);
    int pipes[2];
    ASSERT_EQ(pipe(pipes), 0);
    const pid_t child = fork();
    if (child == 0) write_until_killed(made_, path_, pipes[1]);
    close(pipes[1]);
    int last = -1;
    for (int wanted = 10 + random.below(150); last < wanted;)
      ASSERT_EQ(::read(pipes[0], &last, sizeof last), int(sizeof last));
    usleep(useconds_t(random.below(5000)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (::read(pipes[0], &last, sizeof last) == int(sizeof last)) continue;
    close(pipes[0]);
    const auto before = contents_of(temp_.path());
    const KeptMap map = read_map(path_);
    EXPECT_TRUE(contents_of(temp_.path()) == before);
    EXPECT_GE(int(map.store.size()), last + 1) << "all that had been added";
    EXPECT_EQ(map.warnings.size(), 1u) << "but that it is not finished";
    read += map.store.size();
    for (const char* end : {"-wal", "-shm"}) fs::remove(path_ + end);
  }
  EXPECT_GT(read, 400u);
}

TEST_F(DamagedMap, AKilledMapIsFinishedLater) {
  fs::remove(path_);
  const pid_t child = fork();
  if (child == 0) {
    MapFileWriter writer(path_, made_.header);
    made_.write(&writer);
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  MapFileWriter(path_).finish(made_.run);
  const KeptMap map = read_map(path_);
  EXPECT_TRUE(map.is_finished);
  EXPECT_EQ(map.store.size(), made_.keyframes.size());
  EXPECT_EQ(contents_of(temp_.path()).size(), 1u);
}

}  // namespace
}  // namespace edgevo

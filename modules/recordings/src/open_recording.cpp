// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "edgevo/core/input_file.h"
#include "edgevo/recordings/recording.h"
#include "joined_recording.h"
#include "mcap_file.h"
#include "ros1_bag.h"
#include "ros2_metadata.h"
#include "sqlite_bag.h"
#include "unpack.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// A new folder, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "edgevo_bag_XXXXXX").string()) {
    if (!mkdtemp(path_.data()))
      throw InputError(path_, "cannot be created", "set TMPDIR to a folder with room");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::unique_ptr<Recording> open_plain(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".bag") return open_ros1_bag(path);
  if (ending == ".mcap") return open_mcap(path);
  return open_sqlite_bag(path);
}

// A file that was compressed as a whole: unpacked for as long as it is open, its name gone at once.
std::unique_ptr<Recording> open_packed(const std::string& path) {
  const TemporaryFolder folder;
  const std::string unpacked = (fs::path(folder.path()) / fs::path(path).stem()).string();
  const bool is_whole = unpack_zstd_file(path, unpacked);
  std::unique_ptr<Recording> recording = open_plain(unpacked);
  if (is_whole || !recording->missing().empty()) return recording;
  const std::string kind = recording->kind();
  std::vector<std::unique_ptr<Recording>> parts;
  parts.push_back(std::move(recording));
  return join_recordings(std::move(parts),
                         {kind, "cut off: the end of the compressed file is missing", {}, false});
}

std::unique_ptr<Recording> open_file(const std::string& path) {
  return fs::path(path).extension() == ".zstd" ? open_packed(path) : open_plain(path);
}

// Where a file of metadata.yaml is: older recorders named the folder, too, and some omit ".zstd".
std::string place_of(const std::string& folder, const std::string& name) {
  const fs::path root = folder, file = fs::path(name).filename();
  for (const fs::path& path :
       {root / name, root / file, root / (name + ".zstd"), root / (file.string() + ".zstd")}) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path.string();
  }
  return (root / name).string();
}

// The files of a folder. One of several that cannot be read is skipped, and `missing` says so.
std::vector<std::unique_ptr<Recording>> open_files(const std::string& folder,
                                                   const std::vector<std::string>& names,
                                                   std::string* missing) {
  std::vector<std::unique_ptr<Recording>> parts;
  for (const std::string& name : names) try {
      parts.push_back(open_file(place_of(folder, name)));
    } catch (const InputError& e) {
      if (names.size() == 1) throw;
      *missing += (missing->empty() ? "" : "; ") + name + " is skipped (" + e.what() + ")";
    }
  if (parts.empty()) throw InputError(folder, missing->empty() ? "has no .db3 or .mcap file" : *missing, "");
  return parts;
}

std::unique_ptr<Recording> open_folder(const std::string& folder) {
  Ros2Metadata metadata;
  std::string missing;
  if (has_ros2_metadata(folder)) {
    const std::string path = (fs::path(folder) / "metadata.yaml").string();
    metadata = parse_ros2_metadata(read_text(path, "check the recording"), path);
  } else {
    metadata.files = recorded_files(folder);
    missing = "no metadata.yaml (its recorder did not close it): all files in the folder are read";
  }
  auto parts = open_files(folder, metadata.files, &missing);
  const std::string kind = parts.front()->kind() == "MCAP" ? "ROS 2 bag (MCAP)" : parts.front()->kind();
  return join_recordings(std::move(parts), {kind, missing, metadata.messages, metadata.has_packed_messages});
}

}  // namespace

bool is_recording(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return has_ros2_metadata(path) || !recorded_files(path).empty();
  const fs::path name = fs::path(path).extension() == ".zstd" ? fs::path(path).stem() : fs::path(path);
  const std::string ending = name.extension().string();
  return ending == ".bag" || ending == ".mcap" || ending == ".db3";
}

std::unique_ptr<Recording> open_recording(const std::string& path) {
  return fs::is_directory(path) ? open_folder(path) : open_file(path);
}

}  // namespace edgevo

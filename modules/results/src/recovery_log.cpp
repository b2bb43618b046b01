// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/recovery_log.h"

#include <deque>
#include <filesystem>

#include "bytes.h"
#include "edgevo/core/error.h"
#include "growing_file.h"
#include "recovery_format.h"
#include "recovery_values.h"

namespace edgevo {
namespace {

// Frames that a bootstrap may look back: ten seconds, more than any bootstrap takes.
constexpr size_t kMostWaiting = 300;

template <class T>
std::string as_bytes(const T& value) {
  ByteWriter out;
  write_value(value, &out);
  return out.bytes();
}

}  // namespace

struct RecoveryLog::Impl {
  std::string folder, path;
  GrowingFile file;
  bool broken = false;
  size_t marginalised = 0;
  int revision = 0;
  // Number of records of kind kRevised.
  uint32_t revisions = 0;
  int window = 0;
  std::string newest_camera;
  // Frames since the last pose, the oldest first; at most kMostWaiting.
  std::deque<const FrameRecord*> without_pose;

  void append(const std::string& bytes) {
    if (broken || file.append(bytes)) return;
    broken = true;
    remove();  // leaves the space to the run's own files
  }
  void remove() {
    remove_recovery_log(folder);
    file.close();
  }
  // Keeps the old file until the new one is complete.
  void replace_window(const std::string& bytes) const {
    const std::filesystem::path now = std::filesystem::path(folder) / kRunWindow;
    const std::filesystem::path next = std::filesystem::path(folder) / kNextRunWindow;
    std::error_code error;
    GrowingFile file_of_next;
    if (file_of_next.open(next.string()) && file_of_next.append(bytes))
      std::filesystem::rename(next, now, error);
    std::filesystem::remove(next, error);
  }
  void add_late_poses() {
    for (const FrameRecord* frame : without_pose)
      if (frame->T_world_cam_live) append(recovery_record(RecoveryKind::kLatePose, as_bytes(*frame)));
    without_pose.clear();
  }
};

RecoveryLog::RecoveryLog(const std::string& folder, const RecoveryHeader& header)
    : impl_(std::make_unique<Impl>()) {
  impl_->folder = folder;
  impl_->path = recovery_log_path(folder);
  if (!impl_->file.open(impl_->path))
    throw InputError(impl_->path, "cannot be written", "end other runs into this folder, or give another -o");
  impl_->append(std::string(kRecoveryFirstLine) + recovery_record(RecoveryKind::kHeader, as_bytes(header)));
}

RecoveryLog::~RecoveryLog() = default;

void RecoveryLog::add_frame(const FrameRecord& frame) {
  impl_->append(recovery_record(RecoveryKind::kFrame, as_bytes(frame)));
  if (frame.T_world_cam_live) return impl_->add_late_poses();
  impl_->without_pose.push_back(&frame);
  if (impl_->without_pose.size() > kMostWaiting) impl_->without_pose.pop_front();
}

void RecoveryLog::add_keyframes(const MarginalisedKeyframes& keyframes) {
  const bool is_revised = keyframes.revision != impl_->revision;
  const RecoveryKind kind = is_revised ? RecoveryKind::kRevisedKeyframe : RecoveryKind::kKeyframe;
  for (const KeyframeRecord& keyframe : keyframes.keyframes)
    impl_->append(recovery_record(kind, as_bytes(keyframe)));
  if (is_revised) {
    impl_->append(recovery_record(RecoveryKind::kRevised, {}));
    ++impl_->revisions;
  }
  impl_->marginalised = (is_revised ? 0 : impl_->marginalised) + keyframes.keyframes.size();
  impl_->revision = keyframes.revision;
}

void RecoveryLog::add_window(const ActiveKeyframes& window) {
  if (impl_->broken || window.revision != impl_->revision) return;
  ByteWriter out;
  out.value(impl_->revisions);
  write_value(window.keyframes, &out);
  impl_->replace_window(std::string(kRecoveryFirstLine) +
                        recovery_record(RecoveryKind::kWindow, out.bytes()));
  impl_->window = window.version;
}

void RecoveryLog::add_camera(const CameraRefinement& camera) {
  std::string bytes = as_bytes(camera);
  if (bytes == impl_->newest_camera) return;
  impl_->append(recovery_record(RecoveryKind::kCamera, bytes));
  impl_->newest_camera = std::move(bytes);
}

size_t RecoveryLog::marginalised() const { return impl_->marginalised; }
int RecoveryLog::revision() const { return impl_->revision; }
int RecoveryLog::window() const { return impl_->window; }
bool RecoveryLog::is_broken() const { return impl_->broken; }
void RecoveryLog::remove() { impl_->remove(); }

}  // namespace edgevo

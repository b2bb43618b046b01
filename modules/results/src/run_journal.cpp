#include "edgevo/results/run_journal.h"

#include <deque>
#include <filesystem>

#include "bytes.h"
#include "edgevo/core/error.h"
#include "growing_file.h"
#include "journal_format.h"
#include "journal_values.h"

namespace edgevo {
namespace {

constexpr size_t kMostWaiting =
    300;  // frames that a bootstrap may look back: ten seconds, more than any does

template <class T>
std::string as_bytes(const T& value) {
  ByteWriter out;
  write_value(value, &out);
  return out.bytes();
}

}  // namespace

struct RunJournal::Impl {
  std::string folder, path;
  GrowingFile file;
  bool broken = false;
  size_t settled = 0;
  int revision = 0;
  uint32_t revisions = 0;  // records of kind kRevised
  int window = 0;
  std::string newest_camera;
  std::deque<const FrameRecord*> without_pose;  // of late

  void append(const std::string& bytes) {
    if (broken || file.append(bytes)) return;
    broken = true;
    remove();  // the run's own files need the room
  }
  void remove() {
    remove_journal(folder);
    file.close();
  }
  // The one before stays until the new one is whole.
  void replace_window(const std::string& bytes) const {
    const std::filesystem::path now = std::filesystem::path(folder) / kRunWindow;
    const std::filesystem::path next = std::filesystem::path(folder) / kNewWindow;
    std::error_code error;
    GrowingFile beside;
    if (beside.open(next.string()) && beside.append(bytes)) std::filesystem::rename(next, now, error);
    std::filesystem::remove(next, error);
  }
  void add_late_poses() {
    for (const FrameRecord* frame : without_pose)
      if (frame->T_world_cam_live) append(journal_record(JournalKind::kLatePose, as_bytes(*frame)));
    without_pose.clear();
  }
};

RunJournal::RunJournal(const std::string& folder, const JournalHeader& header)
    : impl_(std::make_unique<Impl>()) {
  impl_->folder = folder;
  impl_->path = journal_path(folder);
  if (!impl_->file.open(impl_->path))
    throw InputError(impl_->path, "cannot be written", "end other runs into this folder, or give another -o");
  impl_->append(std::string(kJournalFirstLine) + journal_record(JournalKind::kHeader, as_bytes(header)));
}

RunJournal::~RunJournal() = default;

void RunJournal::add_frame(const FrameRecord& frame) {
  impl_->append(journal_record(JournalKind::kFrame, as_bytes(frame)));
  if (frame.T_world_cam_live) return impl_->add_late_poses();
  impl_->without_pose.push_back(&frame);
  if (impl_->without_pose.size() > kMostWaiting) impl_->without_pose.pop_front();
}

void RunJournal::add_keyframes(const SettledKeyframes& keyframes) {
  const bool is_revised = keyframes.revision != impl_->revision;
  const JournalKind kind = is_revised ? JournalKind::kRevisedKeyframe : JournalKind::kKeyframe;
  for (const KeyframeRecord& keyframe : keyframes.keyframes)
    impl_->append(journal_record(kind, as_bytes(keyframe)));
  if (is_revised) {
    impl_->append(journal_record(JournalKind::kRevised, {}));
    ++impl_->revisions;
  }
  impl_->settled = (is_revised ? 0 : impl_->settled) + keyframes.keyframes.size();
  impl_->revision = keyframes.revision;
}

void RunJournal::add_window(const UnsettledKeyframes& window) {
  if (impl_->broken || window.revision != impl_->revision) return;
  ByteWriter out;
  out.value(impl_->revisions);
  write_value(window.keyframes, &out);
  impl_->replace_window(std::string(kJournalFirstLine) + journal_record(JournalKind::kWindow, out.bytes()));
  impl_->window = window.version;
}

void RunJournal::add_camera(const CameraRefinement& camera) {
  std::string bytes = as_bytes(camera);
  if (bytes == impl_->newest_camera) return;
  impl_->append(journal_record(JournalKind::kCamera, bytes));
  impl_->newest_camera = std::move(bytes);
}

size_t RunJournal::settled() const { return impl_->settled; }
int RunJournal::revision() const { return impl_->revision; }
int RunJournal::window() const { return impl_->window; }
bool RunJournal::is_broken() const { return impl_->broken; }
void RunJournal::remove() { impl_->remove(); }

}  // namespace edgevo

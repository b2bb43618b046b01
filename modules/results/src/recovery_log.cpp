// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/recovery_log.h"

#include <filesystem>
#include <system_error>

#include "edgevo/core/error.h"
#include "growing_file.h"
#include "recovery_format.h"
#include "recovery_values.h"

namespace edgevo {

struct RecoveryLog::Impl {
  std::string folder, path;
  GrowingFile file;
  bool broken = false;

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
};

RecoveryLog::RecoveryLog(const std::string& folder, const RecoveryHeader& header)
    : impl_(std::make_unique<Impl>()) {
  impl_->folder = folder;
  impl_->path = recovery_log_path(folder);
  if (!impl_->file.open(impl_->path))
    throw InputError(impl_->path, "cannot be written", "end other runs into this folder, or give another -o");
  std::error_code ignored;
  std::filesystem::remove(std::filesystem::path(folder) / kRunWindow, ignored);  // that of another run
  impl_->append(std::string(kRecoveryFirstLine) + recovery_record(kHeaderRecord, bytes_of(header)));
}

RecoveryLog::~RecoveryLog() = default;

void RecoveryLog::add(const std::vector<std::shared_ptr<const MapEvent>>& events) {
  std::string bytes;
  std::shared_ptr<const MapEvent> window;
  for (const std::shared_ptr<const MapEvent>& event : events) {
    if (std::holds_alternative<WindowAdjusted>(*event))
      window = event;
    else
      bytes += recovery_record(kind_of(*event), bytes_of(*event));
  }
  impl_->append(bytes);
  if (window && !impl_->broken)
    impl_->replace_window(std::string(kRecoveryFirstLine) +
                          recovery_record(kind_of(*window), bytes_of(*window)));
}

bool RecoveryLog::is_broken() const { return impl_->broken; }
void RecoveryLog::remove() { impl_->remove(); }

}  // namespace edgevo

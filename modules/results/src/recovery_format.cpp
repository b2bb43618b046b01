// SPDX-License-Identifier: BSD-3-Clause
#include "recovery_format.h"

#include <zlib.h>

#include <filesystem>

#include "bytes.h"

namespace edgevo {

uint32_t recovery_checksum(uint32_t sum, std::string_view bytes) {
  return uint32_t(crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

std::string recovery_record(RecoveryKind kind, const std::string& content) {
  ByteWriter out;
  out.value(kind);
  out.text(content);
  out.value(recovery_checksum(0, out.bytes()));
  return out.bytes();
}

std::string recovery_log_path(const std::string& folder) {
  return (std::filesystem::path(folder) / kRecoveryLog).string();
}

const std::vector<std::string>& recovery_files() {
  static const std::vector<std::string> files{kNextRunWindow, kRunWindow, kRecoveryLog};
  return files;
}

void remove_recovery_log(const std::string& folder) {
  std::error_code ignored;
  for (const std::string& file : recovery_files())
    std::filesystem::remove(std::filesystem::path(folder) / file, ignored);
}

}  // namespace edgevo

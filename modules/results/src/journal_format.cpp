#include "journal_format.h"

#include <zlib.h>

#include <filesystem>

#include "bytes.h"

namespace edgevo {

uint32_t journal_checksum(uint32_t sum, std::string_view bytes) {
  return uint32_t(crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

std::string journal_record(JournalKind kind, const std::string& content) {
  ByteWriter out;
  out.value(kind);
  out.text(content);
  out.value(journal_checksum(0, out.bytes()));
  return out.bytes();
}

std::string journal_path(const std::string& folder) {
  return (std::filesystem::path(folder) / kRunJournal).string();
}

const std::vector<std::string>& journal_files() {
  static const std::vector<std::string> files{kNewWindow, kRunWindow, kRunJournal};
  return files;
}

void remove_journal(const std::string& folder) {
  std::error_code ignored;
  for (const std::string& file : journal_files())
    std::filesystem::remove(std::filesystem::path(folder) / file, ignored);
}

}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#include "record_stream.h"

#include <algorithm>

#include "edgevo/recordings/recording.h"
#include "unpack.h"

namespace edgevo {

std::string_view RecordStream::read(uint64_t length) { return read_head(length, length); }

std::string_view RecordStream::read_head(uint64_t length, uint64_t head) {
  require(length);
  head = std::min(head, length);
  if (head > kMaxUnpacked)
    throw DamagedPart(where_, "a record of " + std::to_string(head) + " bytes", "it is skipped");
  const std::string_view bytes = take(length, head);
  if (bytes.size() < head) throw DamagedPart(where_, "the file became shorter while it was read", "");
  return bytes;
}

void RecordStream::skip(uint64_t length) {
  require(length);
  take(length, 0);
}

void RecordStream::require(uint64_t length) const {
  if (length > remaining())
    throw DamagedPart(where_, "a record states more bytes than follow", "it is skipped");
}

}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
// list_messages FILE: time as recorded (ns), topic, size and CRC-32 of every message of a recording, to be
// compared with what other readers print (tests/unit/recordings/foreign/list_messages.*).
#include <zlib.h>

#include <cinttypes>
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/recordings/recording.h"

int main(int count, char** arguments) try {
  using namespace edgevo;
  if (count != 2) throw InputError(arguments[0], "needs FILE", "");
  const auto recording = open_recording(arguments[1]);
  MessageSelection all;
  for (size_t i = 0; i < recording->topics().size(); ++i) all.topics.push_back(i);
  recording->select(all);
  while (const auto message = recording->next()) {
    const std::string bytes(message->bytes);
    const auto crc = unsigned(crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
    std::printf("%" PRId64 " %s %zu %08x\n", message->recorded_ns,
                recording->topics()[message->topic].name.c_str(), bytes.size(), crc);
  }
} catch (const edgevo::InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "mcap_records.h"

#include <zlib.h>

namespace edgevo {

McapFields& McapFields::pairs(const McapPairs& pairs) {
  McapFields inner;
  for (const auto& [name, value] : pairs) inner.text(name).text(value);
  return text(inner.bytes());
}

std::string mcap_record_head(McapOpcode opcode, uint64_t size) {
  return McapFields().number(uint8_t(opcode)).number(size).bytes();
}

std::string mcap_record(McapOpcode opcode, std::string_view content) {
  return mcap_record_head(opcode, content.size()).append(content);
}

std::string mcap_schema_record(uint16_t id, const McapSchema& schema) {
  return mcap_record(McapOpcode::kSchema,
                     McapFields().number(id).text(schema.name).text("ros2msg").text(schema.text).bytes());
}

std::string mcap_channel_record(uint16_t id, uint16_t schema_id, const McapChannel& channel) {
  return mcap_record(McapOpcode::kChannel, McapFields()
                                               .number(id)
                                               .number(schema_id)
                                               .text(channel.topic)
                                               .text("cdr")
                                               .pairs(channel.metadata)
                                               .bytes());
}

uint32_t crc_after(uint32_t before, std::string_view bytes) {
  return uint32_t(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace edgevo

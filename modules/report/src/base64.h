#pragma once
// Bytes as text that may stand in HTML, JSON and a data: URL (RFC 4648), four characters for three bytes.
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace edgevo

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Base64 encoding (RFC 4648) for HTML, JSON and data: URLs: four characters for three bytes.
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// `bytes` in base64, with padding.
std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace edgevo

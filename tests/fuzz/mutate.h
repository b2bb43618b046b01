// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Seeded mutations of bytes: the same on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/random.h"

namespace edgevo::test {

inline std::string interesting_token(Random* random) {
  static const char* const kTokens[] = {
      "nan",        "inf",   "-1", "0",  "1e999", "-1e-999", "99999999999999999999",
      "2147483648", "0x1p3", " ",  "\n", "\r",    "\t",      "#",
      ":",          "[",     "]",  "{",  "}",     ",",       "-",
      "'",          "\"",    "\\", "%",  "!!",    "../",     "/",
      ".",          "\xff"};
  constexpr int kCount = sizeof kTokens / sizeof kTokens[0];
  const int i = random->below(kCount + 1);
  return i == kCount ? std::string(1, '\0') : kTokens[i];
}

/// Changes, inserts or removes a few bytes.
inline void damage_once(Random* random, std::string* bytes) {
  const int size = int(bytes->size());
  if (size == 0) {
    *bytes = interesting_token(random);
    return;
  }
  const size_t at = size_t(random->below(size));
  const size_t length = size_t(1 + random->below(std::min(16, size)));
  switch (random->below(6)) {
    case 0:
      (*bytes)[at] = char((*bytes)[at] ^ (1 << random->below(8)));
      break;
    case 1:
      (*bytes)[at] = char(random->below(256));
      break;
    case 2:
      bytes->insert(at, interesting_token(random));
      break;
    case 3:
      bytes->replace(at, std::min(length, bytes->size() - at), interesting_token(random));
      break;
    case 4:
      bytes->erase(at, length);
      break;
    default:
      bytes->insert(size_t(random->below(size)), bytes->substr(at, length));
      break;
  }
}

/// Makes one to four changes or, one time in four, truncates the bytes. Not both: a truncated rawlog has no
/// checksum to reveal other damage, and MRPT would then allocate as much memory as the damaged lengths say.
inline std::string mutate(Random* random, std::string bytes) {
  if (random->below(4) == 0) return bytes.substr(0, size_t(random->below(int(bytes.size()))));
  for (int n = 1 + random->below(4); n > 0; --n) damage_once(random, &bytes);
  return bytes;
}

/// Numbers of inputs that were accepted and refused.
struct FuzzCounts {
  int accepted = 0, refused = 0;
};

/// Calls `parse` on `rounds` mutations of `valid` and counts successes and InputErrors; any other exception
/// fails the test (through GoogleTest) with the input that caused it.
template <class Parse>
FuzzCounts fuzz(const std::string& valid, int rounds, uint64_t seed, const Parse& parse) {
  FuzzCounts counts;
  Random random(seed);
  for (int i = 0; i < rounds; ++i) {
    const std::string input = mutate(&random, valid);
    try {
      parse(input);
      ++counts.accepted;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line: " << e.what();
      ++counts.refused;
    } catch (const std::exception& e) {
      ADD_FAILURE() << "round " << i << " threw " << e.what()
                    << "\ninput: " << ::testing::PrintToString(input);
      break;
    }
  }
  return counts;
}

/// Expects that both occurred; otherwise the mutations are too weak or the valid input is not valid.
inline void expect_both(const FuzzCounts& counts) {
  EXPECT_GT(counts.accepted, 0);
  EXPECT_GT(counts.refused, 0);
}

}  // namespace edgevo::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// For hot loops: wide registers and memory prefetch.
//
// EDGEVO_WIDE_CLONES before a vectorisable function compiles it twice, for the x86-64 baseline and for AVX2;
// the program picks the version for the processor at start. Both give the same bits: AVX2 is requested
// without fused multiply-add, and the order of floating-point sums never depends on the width. On other
// platforms, and under sanitizers (which do not support the choice at start), it is empty.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define EDGEVO_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define EDGEVO_WIDE_CLONES
#endif

namespace edgevo {

/// Prefetches the cache line at `address`, which will be read soon: prefetches wait for memory in parallel,
/// reads one after the other.
inline void prefetch(const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

}  // namespace edgevo

#pragma once
// For hot loops: wide registers, and prefetched memory.
// EDGEVO_WIDE_CLONES before a function that compilers vectorise makes them translate it twice, for the x86-64 baseline and for AVX2;
// the program takes the better one that the processor has when it starts. Both give the same bits: AVX2 is asked for without fused
// multiply-add, and the order of floating-point sums never depends on the width.
// Elsewhere, and under sanitizers (which cannot follow the choice at start), it means nothing.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define EDGEVO_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define EDGEVO_WIDE_CLONES
#endif

namespace edgevo {

/// Asks for the cache line at `place`, to be read soon: several such requests wait for memory together, reads one after the other.
inline void prefetch(const void* place) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(place);
#else
  (void)place;
#endif
}

}  // namespace edgevo

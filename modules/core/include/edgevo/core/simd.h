#pragma once
// For hot loops that compilers vectorise: EDGEVO_WIDE_CLONES before a function makes the compiler translate it twice, for the x86-64
// baseline and for AVX2; the program takes the better one that the processor has when it starts. Both give the same bits: AVX2 is asked
// for without fused multiply-add, and the order of floating-point sums never depends on the width.
// Elsewhere, and under sanitizers (which cannot follow the choice at start), it means nothing.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define EDGEVO_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define EDGEVO_WIDE_CLONES
#endif

#pragma once

// Functions with this attribute are compiled twice, and selected at program start. Without
// contraction both give the same bits.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VCARVE_VECTORIZED __attribute__((target_clones("avx2", "default")))
#else
#define VCARVE_VECTORIZED
#endif

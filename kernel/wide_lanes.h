#pragma once

/// Functions marked so are compiled for processors with wide registers, too. The bits are the same.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define CURVEFUSION_WIDE_LANES [[gnu::target_clones("avx2", "default")]]
#else
#define CURVEFUSION_WIDE_LANES
#endif

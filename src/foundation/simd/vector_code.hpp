#pragma once

// g++ gets a version for each level of x86-64, chosen at run time. clang 14 knows neither that nor these pragmas: its
// build runs the loops as they come.
#if defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_INDEPENDENT _Pragma("GCC ivdep")
#else
#define SLIPFRONT_INDEPENDENT
#endif
#if defined(SLIPFRONT_CLONES)  // given: a benchmark of one level
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SLIPFRONT_CLONES
#endif

// Loops compiled for several instruction sets. The best set of the processor is chosen at run time.
//
//   KINESPHERE_INLINE void add_generic(float* a, const float* b, int n) { ... }
//   KINESPHERE_VERSIONS(add, (float* a, const float* b, int n), (a, b, n))
//   ... add(a, b, n);
//
// Only the benchmark uses this: the library runs one code on all processors.
#pragma once

#define KINESPHERE_INLINE [[gnu::always_inline]] inline

// Parameter lists cannot stand in parentheses of their own.
// NOLINTBEGIN(bugprone-macro-parentheses)
#if defined(__x86_64__) && defined(__GNUC__)
#define KINESPHERE_VERSION(name, generic, parameters, arguments, set) \
  [[gnu::noinline, gnu::target(set)]] void name parameters { generic arguments; }
#define KINESPHERE_VERSIONS(name, parameters, arguments)                                                     \
  [[gnu::noinline]] void name##_sse2 parameters { name##_generic arguments; }                                \
  KINESPHERE_VERSION(name##_avx2, name##_generic, parameters, arguments, "avx2")                             \
  KINESPHERE_VERSION(name##_avx512, name##_generic, parameters, arguments,                                   \
                     "avx512f,avx512vl,avx512dq,avx512bw")                                                   \
  const auto name = __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") ? name##_avx512 \
                    : __builtin_cpu_supports("avx2")                                         ? name##_avx2   \
                                                                                             : name##_sse2;
#else
#define KINESPHERE_VERSIONS(name, parameters, arguments) \
  void name parameters { name##_generic arguments; }
#endif
// NOLINTEND(bugprone-macro-parentheses)

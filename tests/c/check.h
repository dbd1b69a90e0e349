// Checks of the tests in C: a failure prints where and why, and ends the program.
#ifndef KINESPHERE_TESTS_C_CHECK_H
#define KINESPHERE_TESTS_C_CHECK_H

#include <kinesphere.h>

#include <stdio.h>
#include <stdlib.h>

#define CHECK(condition) check_true((condition) ? 1 : 0, #condition, __FILE__, __LINE__)
#define CHECK_OK(call) check_status((call), KS_OK, #call, __FILE__, __LINE__)
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)

static inline void check_true(int holds, const char* condition, const char* file, int line) {
  if (holds) return;
  fprintf(stderr, "%s:%d: %s does not hold\n", file, line, condition);
  exit(1);
}

static inline void check_status(ks_status status, ks_status expected, const char* call, const char* file,
                                int line) {
  if (status == expected) return;
  fprintf(stderr, "%s:%d: %s returned %s, not %s: %s\n", file, line, call, ks_status_name(status),
          ks_status_name(expected), ks_last_error_message());
  exit(1);
}

static inline ks_vec3 vec3(double x, double y, double z) {
  ks_vec3 vector;
  vector.x = x;
  vector.y = y;
  vector.z = z;
  return vector;
}

#endif

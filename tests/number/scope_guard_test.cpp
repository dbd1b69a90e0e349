// A guard calls its function once, however the scope is left.
#include "number/scope_guard.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kinesphere::scope_guard_test {
namespace {

TEST(ScopeGuard, CallsWhenTheScopeIsLeft) {
  int calls = 0;
  {
    const ScopeGuard guard([&] { ++calls; });
    EXPECT_EQ(calls, 0);
  }
  EXPECT_EQ(calls, 1);
  try {
    const ScopeGuard guard([&] { ++calls; });
    throw std::runtime_error("out");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(calls, 2);
}

TEST(ScopeGuard, CallsNothingOnceItIsDismissed) {
  int calls = 0;
  {
    ScopeGuard guard([&] { ++calls; });
    guard.dismiss();
  }
  EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace kinesphere::scope_guard_test

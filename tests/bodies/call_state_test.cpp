// Calls from inside of user code: which error each gets, and on which thread a pair filter is asked.
#include "bodies/call_state.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "support/expect_error.hpp"

namespace kinesphere::call_state_test {
namespace {

TEST(CallState, RefusesCallsByName) {
  EXPECT_TRUE(check_idle(CallState::idle, "add"));
  expect_error(check_idle(CallState::probing, "add"), ErrorCode::probe_in_progress, "probe", "add: ");
  expect_error(check_idle(CallState::running, "save"), ErrorCode::run_in_progress, "world", "save: ");
  const auto filtering = check_idle(CallState::filtering, "remove");
  ASSERT_FALSE(filtering);
  EXPECT_EQ(filtering.error().code, ErrorCode::filter_in_progress);
  EXPECT_EQ(filtering.error().argument, "pair_filter");
}

TEST(FilterQuestion, IsAskedByAWorldOnOneThreadWhileItLives) {
  const int one = 0, other = 0;
  EXPECT_FALSE(FilterQuestion::is_asked_by(&one));
  {
    const FilterQuestion question(&one);
    EXPECT_TRUE(FilterQuestion::is_asked_by(&one));
    EXPECT_FALSE(FilterQuestion::is_asked_by(&other));
    {
      const FilterQuestion inner(&other);
      EXPECT_TRUE(FilterQuestion::is_asked_by(&one) && FilterQuestion::is_asked_by(&other));
    }
    EXPECT_FALSE(FilterQuestion::is_asked_by(&other));
    bool elsewhere = true;
    std::thread([&] { elsewhere = FilterQuestion::is_asked_by(&one); }).join();
    EXPECT_FALSE(elsewhere) << "another thread may read the world";
  }
  EXPECT_FALSE(FilterQuestion::is_asked_by(&one));
}

}  // namespace
}  // namespace kinesphere::call_state_test

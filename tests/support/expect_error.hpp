// Checks the message of every refused call of the world.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "kinesphere/result.hpp"

namespace kinesphere {

/// Expects a message of one line that begins with `call` and names the argument.
template <class T>
void expect_error(const Result<T>& result, ErrorCode code, const std::string& argument,
                  const std::string& call, BodyId body = no_body) {
  ASSERT_FALSE(result) << argument;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().argument, argument) << result.error().message;
  EXPECT_EQ(result.error().body, body) << result.error().message;
  EXPECT_EQ(result.error().message.rfind(call, 0), 0u) << result.error().message;
  EXPECT_NE(result.error().message.find(argument), std::string::npos) << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
}

}  // namespace kinesphere

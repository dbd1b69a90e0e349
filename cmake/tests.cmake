# Defines kinesphere_add_tests(), for tests/ and research/.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)

# Recordings and reference tables live outside the project; tests that need them are skipped without them.
set(default_data ${PROJECT_SOURCE_DIR}/../shared/data)
cmake_path(NORMAL_PATH default_data)

# Headers that most tests include are precompiled.
set(headers <kinesphere/kinesphere.hpp> <gtest/gtest.h> <algorithm> <array> <bit> <cmath> <functional> <limits> <map>
            <memory> <optional> <ranges> <set> <span> <string> <tuple> <utility> <variant> <vector>)
# Targets that use the precompiled headers must be compiled with their options.
foreach(library kinesphere_test_headers kinesphere_test_headers_little)
  add_library(${library} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${library} PRIVATE kinesphere GTest::gtest)
  kinesphere_compile(${library})
  target_precompile_headers(${library} PRIVATE ${headers})
endforeach()
kinesphere_optimise_test(kinesphere_test_headers_little)

# Tests that take long and repeat themselves over more streams, scenes, threads or bytes than others, or mostly wait:
# filters of GoogleTest by executable. They have the label `long` (scripts/test.sh --all).
set(kinesphere_long_stream Long/*:*Crowds*:AnyReports.OtherSmall*:Mended.StrangeNumbers*)
set(kinesphere_long_world
    Long/*:BadSnapshot.AnyTwo*:FastSpins.AreNamed*:PlainGap.*:MoreChaos.*:RunsThatWereInterrupted.*)
set(kinesphere_long_simulation Long/*:Pile.Thousand*)
set(kinesphere_long_program WatchNats.*)

# Suites of hundreds of cases that take less time than to start a process. Each is one test of CTest.
set(kinesphere_joined_bound Families)
set(kinesphere_joined_motion All)
set(kinesphere_joined_simulation Scenes)

# Makes test_NAME of these sources, and a test NAME.* of each of its tests or joined suites, with the label NAME or
# `long`.
function(kinesphere_add_tests name)
  set(test test_${name})
  add_executable(${test} ${ARGN})
  target_include_directories(${test} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${test} PRIVATE KINESPHERE_DEFAULT_DATA="${default_data}")
  target_link_libraries(${test} PRIVATE kinesphere_simulation GTest::gtest_main rapidcheck rapidcheck_gtest)
  kinesphere_compile(${test})
  kinesphere_batches_of(${test} 24)
  # These tests take longer to run than to compile.
  if(name MATCHES "^(bound|stream)$")
    target_precompile_headers(${test} REUSE_FROM kinesphere_test_headers)
  else()
    kinesphere_optimise_test(${test})
    # The proof's sources of the library have another type in place of double.
    if(NOT name STREQUAL "proof")
      target_precompile_headers(${test} REUSE_FROM kinesphere_test_headers_little)
    endif()
  endif()
  # With a fixed seed RapidCheck draws equal cases in every run.
  set_target_properties(${test} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  set(common DISCOVERY_TIMEOUT 60 TEST_PREFIX ${name}.)
  set(properties TIMEOUT 600 ENVIRONMENT RC_PARAMS=seed=2005)
  set(long "${kinesphere_long_${name}}")
  set(joined "${kinesphere_joined_${name}}")
  if(joined)
    add_test(NAME ${name}.${joined} COMMAND ${test} --gtest_filter=${joined}/*)
    set_tests_properties(${name}.${joined} PROPERTIES ${properties} LABELS ${name} COST 20)
    set(joined ${joined}/*:)
  endif()
  gtest_discover_tests(${test} ${common} TEST_FILTER "-${joined}${long}" PROPERTIES ${properties} LABELS ${name})
  if(long)
    gtest_discover_tests(${test} ${common} TEST_FILTER "${long}" TEST_LIST long_tests PROPERTIES ${properties} LABELS long)
  endif()
endfunction()

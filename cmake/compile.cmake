# Compile options for all code of this project, for g++ and clang++, and those without which MSVC would go wrong.

# ccache cannot cache compilations with precompiled headers.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# g++ collects garbage from 128 MB on, which takes a tenth of its time. Where there are 4 GB for each processor, it does
# so from 1 GB on: the largest compilation of two batches then takes 1.9 GB.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR megabytes_each "${memory} / ${processors}")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND megabytes_each GREATER_EQUAL 4096)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
endif()

function(kinesphere_compile target)
  if(MSVC)
    # Without contraction, which /fp:fast and /fp:contract allow (see below).
    target_compile_options(${target} PRIVATE /fp:precise /EHsc /GR /bigobj /permissive- /utf-8)
    return()
  endif()
  # On machines with a fused multiply-add, compilers may contract a * b + c into one rounding. Results would then depend
  # on compiler, optimisation level and machine. Users of the library need no such flag: nothing that they compile from
  # its headers computes results (see vec3.hpp).
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # A project around this one may compile all its sources without exceptions, or with an arithmetic of its own.
  if(NOT EMSCRIPTEN)
    target_compile_options(${target} PRIVATE -fexceptions -frtti -fno-fast-math)
  endif()
  # g++ for Windows takes the stack to be aligned for vectors of 32 and 64 bytes, where it is for 16 alone (its bug 54412).
  if(MINGW AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wa,-muse-unaligned-vector-move)
  endif()
  # A project around this one that says nothing of how to build would get what is not optimised.
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    target_compile_options(${target} PRIVATE -O3)
  endif()
  # Warnings are for those who change this code, not for a project around it, which may make them errors.
  if(NOT KINESPHERE_WARNINGS AND NOT KINESPHERE_WERROR)
    target_compile_options(${target} PRIVATE -w)
    return()
  endif()
  # Designated initialisers that leave the other members at their defaults are the style of the library, so
  # they get no warning.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-missing-field-initializers)
  # At -O3 g++ 12 reports false overlaps in std::string and false overflows in fmt (its bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow)
  endif()
  # clang++ takes names of the other sources that are compiled together for shadowed ones, and counts changes of
  # signedness among conversions, as g++ does not.
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE -Wno-shadow -Wno-sign-conversion)
  endif()
  if(KINESPHERE_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# For static libraries that may become part of a shared object, as in the Python package. Their functions are not
# interposed at load time, so calls within a source are as direct as in a program.
function(kinesphere_relocatable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  endif()
endfunction()

# The sources of a target are compiled together in a few batches of about equal size, which reads headers only a few
# times: with one batch it takes three fourths of the work that a batch for each folder takes. KINESPHERE_BATCH says how
# many: a number (by default that of the processors, at most 8), or one for each `folder`, which takes less time after a
# change, or for each `file`. Precondition: no name stands for two things in a target.
set(batches folder)
if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(batches ${processors})
  if(batches GREATER 8)
    set(batches 8)
  endif()
endif()
set(KINESPHERE_BATCH ${batches} CACHE STRING "What is compiled together: so many batches, or each folder or file")
mark_as_advanced(KINESPHERE_BATCH)
# At most as many batches as a third argument says.
function(kinesphere_batches target)
  if(KINESPHERE_BATCH STREQUAL "file")
    return()
  endif()
  set(batches ${KINESPHERE_BATCH})
  if(NOT batches STREQUAL "folder" AND ARGC GREATER 1 AND batches GREATER ARGV1)
    set(batches ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(all_sources ${target} SOURCES)
  set(sources)
  set(all 0)
  foreach(source ${all_sources})
    if(source MATCHES "\\.cpp$")
      cmake_path(ABSOLUTE_PATH source)
      list(APPEND sources ${source})
      file(SIZE ${source} size)
      math(EXPR all "${all} + ${size}")
    endif()
  endforeach()
  # Sources in one folder follow each other, and a batch ends where it has its part of all.
  set(before 0)
  foreach(source ${sources})
    if(batches STREQUAL "folder")
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE group)
      string(MAKE_C_IDENTIFIER "${group}" group)
    else()
      math(EXPR group "${before} * ${batches} / ${all}")
      file(SIZE ${source} size)
      math(EXPR before "${before} + ${size}")
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Batches sources of any folders, `size` at a time: for tests, each with a namespace named after its file.
function(kinesphere_batches_of target size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${size})
endfunction()

# Code with a negligible run time is optimised little in each preset, since that compiles faster.
function(kinesphere_optimise_little target)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<OR:$<CONFIG:Release>,$<CONFIG:>>:-O1>)
  endif()
endfunction()

# Most tests take longer to compile than to run, so they are optimised less. With g++ 12, -Og takes a fourth less than -O1,
# and runs take up to 40 % longer; -O0 takes a third less, but test_motion then runs four times as long.
function(kinesphere_optimise_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
endfunction()

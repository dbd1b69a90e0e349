# Compile options for all code of this project, for g++ and clang++.

# ccache cannot cache compilations with precompiled headers.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# g++ collects garbage from 128 MB on, which takes a tenth of its time. Where there are 4 GB for each processor, it does
# so from 4 GB on: the largest compilation then takes 2.9 GB instead of 1.9.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR megabytes_each "${memory} / ${processors}")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND megabytes_each GREATER_EQUAL 4096)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=4000000>)
endif()

function(kinesphere_compile target)
  # On machines with a fused multiply-add, compilers may contract a * b + c into one rounding. Results would then depend
  # on compiler, optimisation level and machine. Users of the library need no such flag: nothing that they compile from
  # its headers computes results (see vec3.hpp).
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(NOT KINESPHERE_WARNINGS AND NOT KINESPHERE_WERROR)
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
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# The sources of a target are compiled together, as if they were one, which reads headers once: a third less work than
# each folder together. KINESPHERE_BATCH chooses what is compiled together: the `target`, each `folder`, which takes
# less time after a change and less memory, or each `file` alone. Precondition: no name stands for two things in a target.
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(KINESPHERE_BATCH folder CACHE STRING "What is compiled together: target, folder or file")
else()
  set(KINESPHERE_BATCH target CACHE STRING "What is compiled together: target, folder or file")
endif()
mark_as_advanced(KINESPHERE_BATCH)
function(kinesphere_batches target)
  if(KINESPHERE_BATCH STREQUAL "file")
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source)
    if(source MATCHES "\\.cpp$")
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE group)
      string(MAKE_C_IDENTIFIER "${group}" group)
      if(KINESPHERE_BATCH STREQUAL "target")
        set(group all)
      endif()
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# Batches sources of any folders, `size` at a time: for tests, each with a namespace named after its file.
function(kinesphere_batches_of target size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${size})
endfunction()

# Code with a negligible run time is optimised little in each preset, since that compiles faster.
function(kinesphere_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Most tests take longer to compile than to run, so they are optimised less. With g++ 12, -Og takes a fourth less than -O1,
# and runs take up to 40 % longer; -O0 takes a third less, but test_motion then runs four times as long.
function(kinesphere_optimise_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
endfunction()

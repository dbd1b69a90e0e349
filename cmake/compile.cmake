# What all code of this project is compiled with, under g++ and clang++.

function(kinesphere_compile target)
  # Where the machine has a fused multiply-add, compilers may contract a * b + c into one rounding, each as it
  # likes. That would make results depend on compiler, optimisation level and machine. Users of the library
  # need no such flag: nothing that they compile from its headers does its work (see vec3.hpp).
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Designated initialisers that leave the other members at their defaults are the style of the library, so
  # they get no warning.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-missing-field-initializers)
  # At -O3 g++ 12 sees overlaps in std::string and overflows in fmt where there are none (its bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow)
  endif()
  if(KINESPHERE_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# For static libraries that may become part of a shared object, as in the Python package. Nobody puts other functions in
# the place of theirs when a program is loaded, so calls within a source are as direct as in a program.
function(kinesphere_relocatable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# The sources of a folder are compiled together, as if they were one, which reads headers once; with the argument `target`
# those of all folders, for small targets. KINESPHERE_BATCH chooses for all targets: least time in all, where nothing is
# built twice, takes `target`, and `file` compiles each alone. No name may stand for two things in a target.
set(KINESPHERE_BATCH folder CACHE STRING "What is compiled together: each folder, target or file")
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
      if(KINESPHERE_BATCH STREQUAL "target" OR "${ARGV1}" STREQUAL "target")
        set(group all)
      endif()
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# The same for sources of any folders, as many at a time as are given: for tests, each of which has a namespace that bears
# the name of its file.
function(kinesphere_batches_of target size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${size})
endfunction()

# Code that takes no time to run is optimised little, whatever the preset says: that compiles faster.
function(kinesphere_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

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

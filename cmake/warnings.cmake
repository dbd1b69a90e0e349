# The warnings that all code of this project is free of, under g++ and clang++.

function(kinesphere_enable_warnings target)
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

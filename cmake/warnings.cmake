# The warnings that all code of this project is free of, under g++ and clang++.

function(kinesphere_enable_warnings target)
  # Designated initialisers that leave the other members at their defaults are the style of the library, so
  # they get no warning.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-missing-field-initializers)
  if(KINESPHERE_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

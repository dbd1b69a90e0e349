# Programs in C: they show that include/kinesphere.h is C11, without a warning.
enable_language(C)

function(kinesphere_add_c_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE kinesphere::c m)
  # C++ links them, with its sanitizers, if any.
  set_target_properties(${name} PROPERTIES C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF LINKER_LANGUAGE CXX)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)
  if(KINESPHERE_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

# Programs in C: they show that include/kinesphere.h is C11, without a warning.
enable_language(C)

# C11 with all warnings, linked by C++ with its sanitizers, if any.
function(kinesphere_c_target name)
  set_target_properties(${name} PROPERTIES C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF LINKER_LANGUAGE CXX)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)
  if(KINESPHERE_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

function(kinesphere_add_c_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE kinesphere::c m)
  kinesphere_c_target(${name})
endfunction()

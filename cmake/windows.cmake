# Toolchain file: cross-compiles for Windows (x86-64) with g++ of MinGW-w64, as Debian has it, and runs what was built under
# Wine. Programs contain the libraries of the compiler, so they need no DLL of its own. KINESPHERE_WINDOWS_PREFIX is a
# folder with libraries for Windows: Google Highway for the library, GoogleTest and RapidCheck for the tests
# (scripts/windows.sh builds them).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KINESPHERE_WINDOWS_PREFIX)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${KINESPHERE_WINDOWS_PREFIX})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)

# Debian packages, one for each component: `cpack` in the folder of a build that was configured with
# -DCMAKE_INSTALL_PREFIX=/usr makes libkinesphere-c0 (the shared library of the C interface), libkinesphere-dev (headers,
# the static C++ library, CMake and pkg-config files) and, if the program was built, kinesphere.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Kinesphere authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime development)
if(KINESPHERE_BUILD_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
get_target_property(abi kinesphere_c SOVERSION)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libkinesphere-c${abi})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libkinesphere-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libkinesphere-c${abi} (= ${PROJECT_VERSION}), libhwy-dev")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kinesphere)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# What the binaries link, and which symbols programs find in which version.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# The sources, in one file: cpack --config CPackSourceConfig.cmake.
set(CPACK_SOURCE_GENERATOR TXZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME kinesphere-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES "/\\\\.git/" "^${PROJECT_SOURCE_DIR}/(build|bench-[^/]*|debian)/" /node_modules/ /dist/ /_skbuild/
                              "\\\\.egg-info/" /__pycache__/ /target/)
include(CPack)

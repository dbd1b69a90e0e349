# Installs the library with its headers, a CMake package (find_package(kinesphere)) and a pkg-config file. Both find
# everything relative to themselves, so the installed tree may be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/kinesphere)
install(TARGETS kinesphere EXPORT kinesphere INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# distributed installs the headers of the component mpi.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ ${PROJECT_BINARY_DIR}/include/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN distributed EXCLUDE)

install(EXPORT kinesphere NAMESPACE kinesphere:: FILE kinesphere-targets.cmake DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/cmake/kinesphere-config.cmake DESTINATION ${package_dir})
# What docs/versions.md promises.
set(compatible SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatible SameMinorVersion)
endif()
write_basic_package_version_file(${PROJECT_BINARY_DIR}/kinesphere-config-version.cmake COMPATIBILITY ${compatible})
install(FILES ${PROJECT_BINARY_DIR}/kinesphere-config-version.cmake DESTINATION ${package_dir})

set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pkgconfig /prefix/${pkgconfig_dir} /prefix)
# A program that links a static library must link its dependencies, too.
get_target_property(type kinesphere TYPE)
if(type STREQUAL "STATIC_LIBRARY")
  set(libraries "-lkinesphere -lhwy ${CMAKE_THREAD_LIBS_INIT}")
else()
  set(libraries "-lkinesphere")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/kinesphere.pc.in ${PROJECT_BINARY_DIR}/kinesphere.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/kinesphere.pc DESTINATION ${pkgconfig_dir})

# find_package(kinesphere) reads this. The library uses Google Highway and threads inside; who links it statically needs
# them too.
include(CMakeFindDependencyMacro)
include(${CMAKE_CURRENT_LIST_DIR}/kinesphere-targets.cmake)
get_target_property(kinesphere_type kinesphere::kinesphere TYPE)
if(kinesphere_type STREQUAL "STATIC_LIBRARY")
  find_dependency(hwy)
  find_dependency(Threads)
endif()
unset(kinesphere_type)

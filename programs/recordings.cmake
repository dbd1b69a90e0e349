# kinesphere_recording_commands: tracks, view and watch, with all formats of files and streams.
find_package(simdjson REQUIRED)

file(GLOB sources CONFIGURE_DEPENDS kinesphere/recording_commands.cpp kinesphere/formats/*/*.cpp
     kinesphere/geography/*.cpp kinesphere/serving/*.cpp kinesphere/tracks/*.cpp kinesphere/view/*.cpp
     kinesphere/watch/*.cpp kinesphere/watch/source/*.cpp kinesphere/watch/clock/*.cpp
     kinesphere/watch/tracks/*.cpp kinesphere/watch/monitor/*.cpp kinesphere/watch/policy/*.cpp
     kinesphere/watch/output/*.cpp kinesphere/watch/nats/nats_address.cpp)
add_library(kinesphere_recording_commands STATIC ${sources})
target_link_libraries(kinesphere_recording_commands PUBLIC kinesphere_scene_commands simdjson::simdjson)
# Longitudes and latitudes, refused with a word about it where it is not installed.
find_path(GEOGRAPHICLIB_INCLUDE_DIR GeographicLib/LocalCartesian.hpp)
find_library(GEOGRAPHICLIB_LIBRARY GeographicLib)
if(GEOGRAPHICLIB_INCLUDE_DIR AND GEOGRAPHICLIB_LIBRARY)
  target_compile_definitions(kinesphere_recording_commands PRIVATE KINESPHERE_WITH_GEOGRAPHICLIB)
  target_include_directories(kinesphere_recording_commands SYSTEM PRIVATE ${GEOGRAPHICLIB_INCLUDE_DIR})
  target_link_libraries(kinesphere_recording_commands PRIVATE ${GEOGRAPHICLIB_LIBRARY})
endif()
# GPX files, refused with a word about it where expat is not installed.
find_package(EXPAT)
if(EXPAT_FOUND)
  target_compile_definitions(kinesphere_recording_commands PRIVATE KINESPHERE_WITH_EXPAT)
  target_link_libraries(kinesphere_recording_commands PRIVATE EXPAT::EXPAT)
endif()
# Streams of NATS, refused with a word about it where its library is not installed.
find_path(NATS_INCLUDE_DIR nats/nats.h)
find_library(NATS_LIBRARY nats)
if(NATS_INCLUDE_DIR AND NATS_LIBRARY)
  target_sources(kinesphere_recording_commands PRIVATE kinesphere/watch/nats/nats_connection.cpp
                                                       kinesphere/watch/nats/nats_source.cpp
                                                       kinesphere/watch/nats/nats_alerts.cpp)
  add_library(kinesphere_nats INTERFACE)
  target_include_directories(kinesphere_nats SYSTEM INTERFACE ${NATS_INCLUDE_DIR})
  target_compile_definitions(kinesphere_nats INTERFACE KINESPHERE_WITH_NATS)
  target_link_libraries(kinesphere_nats INTERFACE ${NATS_LIBRARY})
  target_link_libraries(kinesphere_recording_commands PRIVATE kinesphere_nats)
else()
  target_sources(kinesphere_recording_commands PRIVATE kinesphere/watch/nats/nats_left_out.cpp)
endif()
target_compile_definitions(kinesphere_recording_commands
                           PRIVATE KINESPHERE_BUILT_VIEWER="${PROJECT_SOURCE_DIR}/build/browser/browser/viewer")
kinesphere_compile(kinesphere_recording_commands)
kinesphere_optimise_little(kinesphere_recording_commands)
kinesphere_batches(kinesphere_recording_commands)

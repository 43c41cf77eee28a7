# Headers that CMake writes into generated/: literals, so that the programs need no files beside them.

# The bridge file of the reference bridge.
file(READ examples/bridges/reference.toml REFERENCE_BRIDGE_TEXT)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS examples/bridges/reference.toml)
configure_file(cmake/reference_bridge_text.h.in generated/reference_bridge_text.h @ONLY)

# Version, compiler and flags. Warnings do not change results, so they are not told.
string(TOUPPER ${CMAKE_BUILD_TYPE} build_type_upper)
get_directory_property(global_options COMPILE_OPTIONS)
list(FILTER global_options EXCLUDE REGEX "^-W")
string(JOIN " " VOUSSOIR_COMPILE_FLAGS ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type_upper}} ${global_options})
configure_file(cmake/build_information.h.in generated/build_information.h @ONLY)

# One hash over the sources that results depend on (see database/records/provenance.h).
file(GLOB_RECURSE result_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} core/*.cpp core/*.h)
list(FILTER result_sources EXCLUDE REGEX "^core/program/")  # how programs start and end
file(GLOB generator_result_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} database/format/field_codec.*
     generator/scenes/*.cpp generator/scenes/*.h generator/uncertainty/*.cpp generator/uncertainty/*.h)
list(APPEND result_sources ${generator_result_sources})
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/generated/solver_revision.h
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${PROJECT_BINARY_DIR}/generated/solver_revision.h
          -DSOURCE_DIR=${PROJECT_SOURCE_DIR} "-DFILES=${result_sources}"
          -P ${PROJECT_SOURCE_DIR}/cmake/write_solver_revision.cmake
  DEPENDS ${result_sources} cmake/write_solver_revision.cmake
  VERBATIM)

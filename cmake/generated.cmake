# Headers made at build time, below ${CMAKE_BINARY_DIR}/generated.
set(PLENOLAB_GENERATED_DIR ${CMAKE_BINARY_DIR}/generated)

# plenolab_revision.h: the revision the program is built from; rewritten only when it changes.
add_custom_target(plenolab_revision
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DOUTPUT=${PLENOLAB_GENERATED_DIR}/plenolab_revision.h
    -P ${CMAKE_SOURCE_DIR}/cmake/revision.cmake
  BYPRODUCTS ${PLENOLAB_GENERATED_DIR}/plenolab_revision.h
  COMMENT "Recording the source revision")

# plenolab_build.h: how it is built; known when configuring.
string(TOUPPER "${CMAKE_BUILD_TYPE}" PLENOLAB_BUILD_TYPE_UPPER)
get_directory_property(PLENOLAB_COMPILE_OPTIONS COMPILE_OPTIONS)
list(JOIN PLENOLAB_COMPILE_OPTIONS " " PLENOLAB_COMPILE_OPTIONS)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${PLENOLAB_BUILD_TYPE_UPPER}} ${PLENOLAB_COMPILE_OPTIONS}"
  PLENOLAB_BUILD_FLAGS)
configure_file(${CMAKE_SOURCE_DIR}/cmake/plenolab_build.h.in ${PLENOLAB_GENERATED_DIR}/plenolab_build.h @ONLY)

# report_assets.h: the style sheet and script of reports as string literals, so that the program needs no files.
set(PLENOLAB_REPORT_ASSETS ${CMAKE_SOURCE_DIR}/analysis/report/report.css ${CMAKE_SOURCE_DIR}/analysis/report/report.js)
add_custom_command(OUTPUT ${PLENOLAB_GENERATED_DIR}/report_assets.h
  COMMAND ${CMAKE_COMMAND} -DCSS=${CMAKE_SOURCE_DIR}/analysis/report/report.css
    -DJS=${CMAKE_SOURCE_DIR}/analysis/report/report.js -DOUTPUT=${PLENOLAB_GENERATED_DIR}/report_assets.h
    -P ${CMAKE_SOURCE_DIR}/cmake/report_assets.cmake
  DEPENDS ${PLENOLAB_REPORT_ASSETS} ${CMAKE_SOURCE_DIR}/cmake/report_assets.cmake
  COMMENT "Embedding the report's style sheet and script")
add_custom_target(plenolab_report_assets DEPENDS ${PLENOLAB_GENERATED_DIR}/report_assets.h)

# Hash of what decides how an image is tone mapped and measured, for results that are found by their content
# (experiments/batch/plan.h). Included by the top CMakeLists.txt it declares the build step; run with cmake -P it is
# that step and writes OUTPUT.
#
# It covers all sources of the layers below, how one item is computed, and the version of the compiler. The test
# MethodSources follows the includes and names what is not in the lists.
set(method_folders core/base core/image core/io core/lightfield core/tonemap metrics)
set(method_files "")
foreach(name batch/measure batch/adjusted batch/input score tonemap_fit tonemap_field cli/inputs)
  list(APPEND method_files experiments/${name}.h experiments/${name}.cpp)
endforeach()
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(files "")
  foreach(folder IN LISTS method_folders)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.h ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
    list(APPEND files ${found})
  endforeach()
  list(TRANSFORM method_files PREPEND ${CMAKE_SOURCE_DIR}/)
  set(output ${PLENOLAB_GENERATED_DIR}/method_sources.h)
  set(tools "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D ROOT=${CMAKE_SOURCE_DIR} -D OUTPUT=${output} -D TOOLS=${tools}
      -P ${CMAKE_CURRENT_LIST_FILE}
    DEPENDS ${files} ${method_files} ${CMAKE_CURRENT_LIST_FILE}
    COMMENT "Hashing the sources of tone mapping and metrics" VERBATIM)
  target_sources(plenolab_experiments PRIVATE ${output})
  return()
endif()

set(files "")
foreach(folder IN LISTS method_folders)
  file(GLOB_RECURSE found ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
  list(APPEND files ${found})
endforeach()
list(TRANSFORM method_files PREPEND ${ROOT}/)
list(APPEND files ${method_files})
list(SORT files)
set(text "${TOOLS}\n")
foreach(file IN LISTS files)
  file(SHA256 ${file} digest)
  file(RELATIVE_PATH name ${ROOT} ${file})
  string(APPEND text "${name} ${digest}\n")
endforeach()
string(SHA256 digest "${text}")
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [=[#pragma once

// Written by cmake/method_sources.cmake at build time.
namespace plenolab::method_sources {

inline constexpr const char* kHash = "@digest@";

}  // namespace plenolab::method_sources
]=])

# Content hashes of what decides how each scene looks, for the render cache (stimuli/render_cache.h). Included by the
# top CMakeLists.txt it declares the build step; run with cmake -P it is that step and writes OUTPUT.
#
# A scene file is stimuli/scenes/X.cpp without a header X.h of its own. It depends on the headers it includes from
# stimuli/scenes, on theirs, and on the sources named after such a header (parts.h: parts.cpp, parts_*.cpp). The common
# hash covers everything else below stimuli, what no scene reaches, the files of core that decide numbers of a
# rendering, and the versions of compiler and ray tracer. The table of scenes counts nowhere: it only names them.
# Nor does stimuli/direct, whose views are not cached.
set(core_files core/base/random.h core/image/colour.h core/image/colour.cpp core/lightfield/view_grid.h
  core/lightfield/view_grid.cpp)
if(NOT CMAKE_SCRIPT_MODE_FILE)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/stimuli/*.h ${CMAKE_SOURCE_DIR}/stimuli/*.cpp)
  set(output ${CMAKE_BINARY_DIR}/generated/stimuli_sources.h)
  list(TRANSFORM core_files PREPEND ${CMAKE_SOURCE_DIR}/)
  set(tools "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, Embree ${embree_VERSION}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D ROOT=${CMAKE_SOURCE_DIR} -D OUTPUT=${output} -D TOOLS=${tools}
      -P ${CMAKE_CURRENT_LIST_FILE}
    DEPENDS ${files} ${CMAKE_CURRENT_LIST_FILE} ${core_files}
    COMMENT "Hashing the sources of the stimuli" VERBATIM)
  target_sources(plenolab_stimuli PRIVATE ${output})
  return()
endif()

cmake_policy(SET CMP0057 NEW)
set(scenes ${ROOT}/stimuli/scenes)
set(table ${scenes}/table.h ${scenes}/table.cpp)

# closure(RESULT FILE): the file and all it depends on below stimuli/scenes.
function(closure result start)
  set(reached "")
  set(open ${start})
  while(open)
    list(POP_FRONT open file)
    if(file IN_LIST reached OR file IN_LIST table)
      continue()
    endif()
    list(APPEND reached ${file})
    file(STRINGS ${file} lines REGEX "^#include \"stimuli/scenes/")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]*)\".*" "${ROOT}/\\1" header "${line}")
      string(REGEX REPLACE "\\.h$" "" stem ${header})
      file(GLOB partners ${stem}.cpp ${stem}_*.cpp)
      list(APPEND open ${header} ${partners})
    endforeach()
  endwhile()
  list(SORT reached)
  set(${result} ${reached} PARENT_SCOPE)
endfunction()

# hash_of(RESULT FILE...): of names and contents.
function(hash_of result)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(SHA256 ${file} digest)
    file(RELATIVE_PATH name ${ROOT} ${file})
    string(APPEND text "${name} ${digest}\n")
  endforeach()
  string(SHA256 digest "${text}")
  set(${result} ${digest} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE all ${ROOT}/stimuli/*.h ${ROOT}/stimuli/*.cpp)
file(GLOB candidates ${scenes}/*.cpp)
set(covered "")
set(rows "")
foreach(file IN LISTS candidates)
  string(REGEX REPLACE "\\.cpp$" ".h" header ${file})
  if(EXISTS ${header})
    continue()
  endif()
  closure(files ${file})
  list(APPEND covered ${files})
  hash_of(digest ${files})
  get_filename_component(stem ${file} NAME_WE)
  string(APPEND rows "    {\"${stem}\", \"${digest}\"},\n")
endforeach()

set(common ${all})
list(REMOVE_ITEM common ${covered} ${table} "")
list(FILTER common EXCLUDE REGEX "/stimuli/direct/")
list(TRANSFORM core_files PREPEND ${ROOT}/)
list(APPEND common ${core_files})
list(SORT common)
hash_of(common_digest ${common})
string(SHA256 common_digest "${common_digest} ${TOOLS}")
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [=[#pragma once

// Written by cmake/stimuli_sources.cmake at build time.
namespace plenolab::stimuli_sources {

struct SceneSource {
  const char* stem;
  const char* hash;
};
inline constexpr const char* kCommonHash = "@common_digest@";
inline constexpr SceneSource kScenes[] = {
@rows@    {"", ""}};

}  // namespace plenolab::stimuli_sources
]=])

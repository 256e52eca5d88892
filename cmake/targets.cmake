# plenolab_layer(NAME FOLDER DEPENDS ... [EXCLUDE file]): a static library plenolab_NAME of all sources below FOLDER.
# Sources are globbed so that adding an operator, metric or scene is one new file and no edit here.
function(plenolab_layer name folder)
  cmake_parse_arguments(ARG "" "EXCLUDE" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(ARG_EXCLUDE)
    list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/${ARG_EXCLUDE})
  endif()
  if(sources)
    add_library(plenolab_${name} STATIC ${sources})
    target_link_libraries(plenolab_${name} PUBLIC ${ARG_DEPENDS})
  else()
    add_library(plenolab_${name} INTERFACE)
    target_link_libraries(plenolab_${name} INTERFACE ${ARG_DEPENDS})
  endif()
endfunction()

# Instrumented code takes twice as long to optimise as to compile: with sanitizers, layers that compute are optimised
# and those that only call them are not.
function(plenolab_compile_quickly target)
  if(PLENOLAB_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()

# plenolab_test(NAME FOLDER DEPENDS ...): one GoogleTest program of all sources below FOLDER.
function(plenolab_test name folder)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  plenolab_compile_quickly(test_${name})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gtest GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE
    PLENOLAB_SOURCE_DIR="${CMAKE_SOURCE_DIR}" PLENOLAB_PROGRAM="${CMAKE_BINARY_DIR}/bin/plenolab")
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300)
endfunction()

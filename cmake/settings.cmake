# Compiler settings shared by every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Every translation unit of a default build lands in one of a few folders that are easy to find.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(PLENOLAB_CCACHE ccache)
if(PLENOLAB_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PLENOLAB_CCACHE})
endif()

# Contraction would make scalar and vector code round differently; results must not depend on the code path.
add_compile_options(-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -ffp-contract=off -fno-math-errno)
# Options structs are filled by designated initialisers; the members left out have defaults.
add_compile_options(-Wno-missing-field-initializers)
if(PLENOLAB_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(PLENOLAB_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Instrumented code hides initialisations from this warning: g++ 12 gives it for std::regex.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

include_directories(${CMAKE_SOURCE_DIR})
include_directories(${CMAKE_BINARY_DIR}/generated)

# External libraries, all Debian 12 packages (packages.txt).
find_package(OpenEXR 3.1 REQUIRED CONFIG)
find_package(embree 3.13 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(Eigen3 3.4 REQUIRED CONFIG NO_MODULE)
find_package(Ceres 2.1 REQUIRED CONFIG)
find_package(Boost 1.74 REQUIRED CONFIG)
find_package(SDL2 2.26 REQUIRED CONFIG)
find_package(SDL2_ttf 2.20 REQUIRED CONFIG)
find_package(SQLite3 3.40 REQUIRED)
find_package(CLI11 REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(spdlog REQUIRED CONFIG)
find_package(PkgConfig REQUIRED)

pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
add_library(hwy::hwy ALIAS PkgConfig::HWY)

# Debian's OpenCV component packages ship neither a CMake config nor a .pc file.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(plenolab_opencv INTERFACE)
target_include_directories(plenolab_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module core imgproc imgcodecs)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  target_link_libraries(plenolab_opencv INTERFACE ${OPENCV_${module}_LIBRARY})
endforeach()

# Only a benchmark uses it: the tone mapping operators of OpenCV, as a peer.
find_library(OPENCV_photo_LIBRARY opencv_photo REQUIRED)
add_library(plenolab_opencv_photo INTERFACE)
target_link_libraries(plenolab_opencv_photo INTERFACE plenolab_opencv ${OPENCV_photo_LIBRARY})

find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
find_library(XXHASH_LIBRARY xxhash REQUIRED)
add_library(plenolab_xxhash INTERFACE)
target_include_directories(plenolab_xxhash SYSTEM INTERFACE ${XXHASH_INCLUDE_DIR})
target_link_libraries(plenolab_xxhash INTERFACE ${XXHASH_LIBRARY})

# C++17, optimised unless asked otherwise, strict warnings. Our scripts build with STEREO_NAV_WERROR=ON.
option(STEREO_NAV_WERROR "Treat compiler warnings as errors" OFF)
set(STEREO_NAV_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined or thread")

# Several sources of one target are compiled together: headers are parsed and templates instantiated once for all of them,
# which halves the processor time of a build. For work on one room OFF may be better: a change then compiles its own
# file alone.
option(STEREO_NAV_UNITY "Compile the sources of a target in batches" ON)
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)  # for clang-tidy: scripts/lint.sh --tidy
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# GNU ld takes half a second for each of our programs, lld and gold a tenth of that.
set(STEREO_NAV_LINKER "" CACHE STRING "Linker as in -fuse-ld=, e.g. bfd; empty: the first of lld and gold that is installed")
set(linker ${STEREO_NAV_LINKER})
include(CheckCXXSourceCompiles)
foreach(candidate lld gold)
  if(NOT linker)
    set(CMAKE_REQUIRED_FLAGS -fuse-ld=${candidate})
    check_cxx_source_compiles("int main() { return 0; }" STEREO_NAV_HAS_${candidate})
    unset(CMAKE_REQUIRED_FLAGS)
    if(STEREO_NAV_HAS_${candidate})
      set(linker ${candidate})
    endif()
  endif()
endforeach()
if(linker)
  add_link_options(-fuse-ld=${linker})
endif()

add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor)
if(STEREO_NAV_WERROR)
  add_compile_options(-Werror)
endif()
if(STEREO_NAV_SANITIZE)
  # Such a build checks the assertions of Eigen and of the standard library, too.
  add_compile_options(-fsanitize=${STEREO_NAV_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -g1 -O1
    -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  if(STEREO_NAV_SANITIZE MATCHES "address" AND STEREO_NAV_SANITIZE MATCHES "undefined")
    # AddressSanitizer reports bad accesses by itself, and Eigen asserts its alignment: without a second check of each access
    # a build takes two thirds of the time, and its code half the space.
    add_compile_options(-fno-sanitize=null,alignment,vptr,pointer-overflow,object-size)
  endif()
  # Under AddressSanitizer Eigen would allocate in its own way, and memory of ours would be freed in the plain way by an
  # equal template instantiation that the loader takes from a system library (liborocos-kdl has LDLT<MatrixXd>).
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_link_options(-fsanitize=${STEREO_NAV_SANITIZE})
endif()

# SPDX-License-Identifier: MIT
# Files that are compiled once per lane width, each width with the flags of the instructions that it needs.

# WIDTH:FLAG,FLAG… of single and of double precision. Every list of widths is read from here.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(AVX2 "-mavx2,-mfma,-mprefer-vector-width=256")
  set(AVX512 "-mavx512f,-mavx512dq,-mavx512bw,-mavx512vl,-mfma,-mprefer-vector-width=512")
  # Widths that few processors use are built with -O1, in half the time. Scalar kernels are as fast as with -O2, those of SSE2 1 to 5% slower.
  set(MANGATA_LANES 1:-O1 4:-msse2,-O1 8:${AVX2} 16:${AVX512})
  set(MANGATA_DOUBLE_LANES 1:-O1 4:${AVX2} 8:${AVX512})
else()
  set(MANGATA_LANES 1:-O2 4:-O2)
  set(MANGATA_DOUBLE_LANES 1:-O2)
endif()

# Sanitizers watch scalar kernels and the widest ones that this processor runs: the others are the same source. Where that is not known they watch all.
set(MANGATA_SANITIZED_LANES .)
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo processor REGEX "^flags" LIMIT_COUNT 1)
  if(processor MATCHES "avx512vl")
    set(MANGATA_SANITIZED_LANES "^1:|avx512")
  elseif(processor MATCHES "avx2")
    set(MANGATA_SANITIZED_LANES "^1:|mavx2")
  endif()
endif()

# Adds SOURCE to the library once for each width of the list that follows, with DEFINITION=WIDTH.
function(add_lanes name source definition)
  foreach(lanes IN LISTS ARGN)
    string(REGEX MATCH "^([0-9]+):(.*)$" pair "${lanes}")
    set(width ${CMAKE_MATCH_1})
    string(REPLACE "," ";" flags "${CMAKE_MATCH_2}")
    add_library(${name}_${width} OBJECT ${source})
    target_include_directories(${name}_${width} PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_compile_definitions(${name}_${width} PRIVATE ${definition}=${width})
    target_compile_options(${name}_${width} PRIVATE ${flags} -Wno-unused-parameter)
    if(MANGATA_SANITIZE)
      # Kernels take minutes to build with sanitizers, at -O1 half as many. gcc ends vector code by vzeroupper only with expensive optimizations, and without
      # it scalar code that follows takes twenty times as long on some processors.
      target_compile_options(${name}_${width} PRIVATE -O1 $<$<C_COMPILER_ID:GNU>:-fexpensive-optimizations>)
      if(MANGATA_FUZZ OR NOT "${lanes}" MATCHES "${MANGATA_SANITIZED_LANES}") # fuzzed files do not reach them
        target_compile_options(${name}_${width} PRIVATE -fno-sanitize=all)
      endif()
    endif()
    set_property(GLOBAL APPEND PROPERTY MANGATA_LANE_OBJECTS $<TARGET_OBJECTS:${name}_${width}>)
  endforeach()
endfunction()

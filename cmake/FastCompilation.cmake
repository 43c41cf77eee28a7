# A build from nothing spends most of its time on reading the same headers, and on compiling what they hold, once for each
# file. So libraries and tests are compiled several files at a time (names of anonymous namespaces have to differ within a
# folder), and programs and tests read the headers of the libraries that they share from one precompiled file. The preset
# dev does neither: there every file has to include what it uses.
option(VOUSSOIR_COMPILE_TOGETHER "Compile libraries and tests several files at a time, precompile headers" ON)

# voussoir_compile_together(TARGET)
function(voussoir_compile_together target)
  if(VOUSSOIR_COMPILE_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # To the compiler the sources are headers then, where types of anonymous namespaces would be a mistake.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# voussoir_precompile(TARGET HEADER..): the target reads these headers, and the commonest ones, from a precompiled file.
function(voussoir_precompile target)
  if(VOUSSOIR_COMPILE_TOGETHER)
    target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <filesystem> <functional> <map> <optional> <random> <set>
                              <span> <string> <vector> <Eigen/Dense> <fmt/format.h> ${ARGN})
  endif()
endfunction()

# voussoir_precompiled_as(TARGET OTHER): the target reads the precompiled file of another one with the same flags.
function(voussoir_precompiled_as target other)
  if(VOUSSOIR_COMPILE_TOGETHER)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()

# The compiler's own collection of garbage, which takes a tenth of its time (more under sanitizers), waits for four gigabytes.
add_compile_options("$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-expand=1000 --param ggc-min-heapsize=4000000>")

# ccache, where it is installed, with what it needs to know to keep what was compiled with precompiled headers.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  add_compile_options(-fpch-preprocess)
endif()

# koshi_kernels(SOURCE) compiles a source of inner loops once per instruction set, with KOSHI_ISA set to the set's name;
# the program chooses at run time. Signed zeros, traps, non-numbers and errno do not matter inside such loops.
set(KOSHI_KERNEL_SETS baseline)
set(KOSHI_KERNEL_FLAGS_baseline "")
set(KOSHI_KERNEL_DEFINITION "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND KOSHI_KERNEL_SETS avx2 avx512)
  set(KOSHI_KERNEL_FLAGS_avx2 -mavx2 -mfma)
  set(KOSHI_KERNEL_FLAGS_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)
  set(KOSHI_KERNEL_DEFINITION KOSHI_X86_KERNELS)
endif()

function(koshi_kernels source)
  get_filename_component(stem ${source} NAME_WE)
  foreach(set ${KOSHI_KERNEL_SETS})
    add_library(koshi_${stem}_${set} OBJECT ${source})
    target_include_directories(koshi_${stem}_${set} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
    target_compile_options(koshi_${stem}_${set} PRIVATE -O3 -Wall -Wextra $<$<BOOL:${KOSHI_WERROR}>:-Werror>
      -fno-signed-zeros -ffinite-math-only -fno-trapping-math -fno-math-errno -Wno-psabi ${KOSHI_KERNEL_FLAGS_${set}})
    target_compile_definitions(koshi_${stem}_${set} PRIVATE KOSHI_ISA=${set})
    target_sources(koshi PRIVATE $<TARGET_OBJECTS:koshi_${stem}_${set}>)
  endforeach()
endfunction()

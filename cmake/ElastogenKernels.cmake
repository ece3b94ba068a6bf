# elastogen_add_kernels(TARGET ASSOCIATIONS id... [LAWS folder...] [PROFILE name]
#                       [PRECISIONS double|float...] [INSTRUCTION_SETS set...])
#
# Makes TARGET, a static library of generated kernels:
#
#   elastogen_add_kernels(beam_kernels ASSOCIATIONS stvk-hexa8-q8-none hooke-tet4-q1-none)
#   target_link_libraries(simulator PRIVATE beam_kernels)
#
#   #include "stvk_hexa8_q8_none_tables.h"   // declares the functions that return the tables
#
# LAWS are folders of law files of one's own, searched before the shipped ones. The sources of an
# association depend on the generator and on the file of its law alone: editing a law rebuilds
# exactly its kernels, and editing a comment in it rebuilds none.
#
# Kernels are compiled in PRECISIONS (not given: both), once for each of INSTRUCTION_SETS; the
# functions return the tables of the best that the processor has. Not given:
# ELASTOGEN_KERNEL_INSTRUCTION_SETS. With `native` alone there is no choice.
#
# The generator is ELASTOGEN_EXECUTABLE where set, else the target elastogen::elastogen, else the
# program in PATH. Shipped laws are those beside the folder that this file stands in, in the source
# tree as installed.
include_guard()
include(CheckCXXCompilerFlag)

set(ELASTOGEN_EXECUTABLE "" CACHE FILEPATH
  "Generator; empty: the target elastogen::elastogen, or the program in PATH")
set(_elastogen_flags -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Of a long kernel's instructions half move spilled values; these save a fifth of them.
  list(APPEND _elastogen_flags -flive-range-shrinkage -frename-registers)
endif()
set(ELASTOGEN_KERNEL_FLAGS ${_elastogen_flags} CACHE STRING
  "Compiler options of generated kernels; used for nothing else")
set(_elastogen_sets native)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(_elastogen_sets x86_64 avx2 avx512)
endif()
set(ELASTOGEN_KERNEL_INSTRUCTION_SETS ${_elastogen_sets} CACHE STRING
  "Instruction sets that kernels are compiled for: some of x86_64 avx2 avx512, or native")

# Sets `variable` to the compiler options of an instruction set, after checking that the compiler
# knows them. A batch fills one 64-byte register of AVX-512, which gcc halves unless told.
function(_elastogen_instruction_set_options variable set)
  set(full_width "")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(full_width -mprefer-vector-width=512)
  endif()
  set(options_of_native -march=native ${full_width})
  set(options_of_x86_64 -march=x86-64)
  set(options_of_avx2 -march=x86-64-v3)
  set(options_of_avx512 -march=x86-64-v4 ${full_width})
  if(NOT DEFINED options_of_${set})
    message(FATAL_ERROR "ELASTOGEN_KERNEL_INSTRUCTION_SETS: '${set}' is no instruction set that "
      "kernels can be compiled for; give some of x86_64, avx2, avx512, or native")
  endif()
  string(REPLACE ";" " " options "${options_of_${set}}")
  check_cxx_compiler_flag("${options}" ELASTOGEN_COMPILES_FOR_${set})
  if(NOT ELASTOGEN_COMPILES_FOR_${set})
    message(FATAL_ERROR "ELASTOGEN_KERNEL_INSTRUCTION_SETS: the compiler "
      "(${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} for ${CMAKE_SYSTEM_PROCESSOR}) does "
      "not take '${options}', the options of '${set}'; leave '${set}' out, or give native")
  endif()
  set(${variable} "${options_of_${set}}" PARENT_SCOPE)
endfunction()

# Sets `variable` to the instruction sets in the order of selection, the best one last.
function(_elastogen_order_instruction_sets variable)
  set(wanted ${ARGN})
  set(ordered "")
  foreach(set IN ITEMS x86_64 avx2 avx512 native)
    if(set IN_LIST wanted)
      list(APPEND ordered ${set})
    endif()
  endforeach()
  list(REMOVE_ITEM wanted x86_64 avx2 avx512 native)
  list(APPEND ordered ${wanted})  # unknown ones: _elastogen_instruction_set_options refuses them
  list(LENGTH ordered count)
  if(count EQUAL 0 OR ("native" IN_LIST ordered AND count GREATER 1))
    string(REPLACE ";" ", " found "${ordered}")
    message(FATAL_ERROR "ELASTOGEN_KERNEL_INSTRUCTION_SETS: '${found}': give some of x86_64, avx2, "
      "avx512, or native alone: whether a processor has what was native elsewhere cannot be known")
  endif()
  set(${variable} "${ordered}" PARENT_SCOPE)
endfunction()

# The source that has the function `symbol` choose among the builds for the instruction sets.
function(_elastogen_write_selection file association symbol scalar)
  set(declarations "")
  set(builds "")
  set(table "const elastogen::KernelTable<${scalar}>*")
  foreach(set IN LISTS ARGN)
    string(APPEND declarations "${table} ${symbol}_${set}();\n")
    string(APPEND builds "      {\"${set}\", ${symbol}_${set}},\n")
  endforeach()
  file(CONFIGURE OUTPUT "${file}" CONTENT
"// Written by elastogen's CMake: which build of the kernels of ${association} is taken.
#include \"runtime/kernel_selection.h\"

extern \"C\" {
${declarations}${table} ${symbol}();
}

${table} ${symbol}() {
  static ${table} const chosen = elastogen::choose_table<${scalar}>(\"${association}\", {
${builds}  });
  return chosen;
}
" @ONLY)
endfunction()

# Makes `target`, a static library of the kernels of ASSOCIATIONS: each of their sources, found by the
# target's include folders, is compiled once for each instruction set. All objects are of one target,
# so that what a project asks of it (position-independent code, say) holds for them.
function(_elastogen_kernel_library target)
  cmake_parse_arguments(ARG "" "" "ASSOCIATIONS;PRECISIONS;INSTRUCTION_SETS" ${ARGN})
  if("${ELASTOGEN_KERNEL_FLAGS}" MATCHES "-march=")
    message(FATAL_ERROR "ELASTOGEN_KERNEL_FLAGS = '${ELASTOGEN_KERNEL_FLAGS}': leave -march out; "
      "kernels are compiled for ELASTOGEN_KERNEL_INSTRUCTION_SETS, of which native is -march=native")
  endif()
  _elastogen_order_instruction_sets(sets ${ARG_INSTRUCTION_SETS})
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}/builds")
  set(suffix_of_double f64)
  set(suffix_of_float f32)
  set(sources "")
  foreach(association IN LISTS ARG_ASSOCIATIONS)
    string(REPLACE "-" "_" identifier ${association})
    foreach(scalar IN LISTS ARG_PRECISIONS)
      set(name ${identifier}_${suffix_of_${scalar}})
      foreach(set IN LISTS sets)
        _elastogen_instruction_set_options(options ${set})
        set(source "${folder}/${name}_${set}.cpp")
        set(define_set "#define ELASTOGEN_INSTRUCTION_SET ${set}\n")
        if(set STREQUAL "native")  # the only build: its functions are those that users call
          set(define_set "")
        endif()
        file(CONFIGURE OUTPUT "${source}" CONTENT
"// Written by elastogen's CMake: kernels of ${association}, compiled for ${set}.
${define_set}#include \"${name}.cpp\"
" @ONLY)
        set_source_files_properties("${source}" PROPERTIES
          COMPILE_OPTIONS "${ELASTOGEN_KERNEL_FLAGS};${options}")
        list(APPEND sources "${source}")
      endforeach()
      if(NOT sets STREQUAL "native")
        set(source "${folder}/${name}_selection.cpp")
        _elastogen_write_selection("${source}" ${association} elastogen_kernels_${name}_simd
          ${scalar} ${sets})
        list(APPEND sources "${source}")
      endif()
    endforeach()
  endforeach()
  add_library(${target} STATIC ${sources})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC elastogen::kernel_headers)
endfunction()

# Sets `variable` to the generator, as a command of a build rule.
function(_elastogen_find_generator variable)
  if(ELASTOGEN_EXECUTABLE)
    set(${variable} "${ELASTOGEN_EXECUTABLE}" PARENT_SCOPE)
    return()
  endif()
  if(TARGET elastogen::elastogen)
    set(${variable} $<TARGET_FILE:elastogen::elastogen> PARENT_SCOPE)
    return()
  endif()
  find_program(program elastogen NO_CACHE)
  if(NOT program)
    message(FATAL_ERROR "elastogen_add_kernels: there is no generator: elastogen was built with "
      "ELASTOGEN_GENERATOR=OFF and no program 'elastogen' is in PATH; set ELASTOGEN_EXECUTABLE, or "
      "link elastogen::default_kernels")
  endif()
  set(${variable} "${program}" PARENT_SCOPE)
endfunction()

# Sets `variable` to the file of a law: the first folder that has it.
function(_elastogen_find_law variable law)
  foreach(folder IN LISTS ARGN)
    if(EXISTS "${folder}/${law}.toml")
      set(${variable} "${folder}/${law}.toml" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  string(REPLACE ";" ", " folders "${ARGN}")
  message(FATAL_ERROR "elastogen_add_kernels: no law '${law}' (${law}.toml) in: ${folders}")
endfunction()

function(elastogen_add_kernels target)
  cmake_parse_arguments(ARG "" "PROFILE" "ASSOCIATIONS;LAWS;PRECISIONS;INSTRUCTION_SETS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "elastogen_add_kernels: unknown argument '${ARG_UNPARSED_ARGUMENTS}'; "
      "the call is elastogen_add_kernels(TARGET ASSOCIATIONS id... [LAWS folder...] "
      "[PROFILE name] [PRECISIONS double|float...] [INSTRUCTION_SETS set...])")
  endif()
  if(NOT ARG_PRECISIONS)
    set(ARG_PRECISIONS double float)
  endif()
  foreach(precision IN LISTS ARG_PRECISIONS)
    if(NOT precision MATCHES "^(double|float)$")
      message(FATAL_ERROR "elastogen_add_kernels(${target}): PRECISIONS '${precision}' is none that "
        "kernels can be compiled in; give double, float or both")
    endif()
  endforeach()
  if(NOT ARG_INSTRUCTION_SETS)
    set(ARG_INSTRUCTION_SETS ${ELASTOGEN_KERNEL_INSTRUCTION_SETS})
  endif()
  if(NOT ARG_ASSOCIATIONS)
    message(FATAL_ERROR "elastogen_add_kernels(${target}): no ASSOCIATIONS")
  endif()
  _elastogen_find_generator(generator)
  set(options "")
  set(law_folders "")
  foreach(folder IN LISTS ARG_LAWS)
    get_filename_component(folder "${folder}" ABSOLUTE)
    list(APPEND law_folders "${folder}")
    list(APPEND options --laws "${folder}")
  endforeach()
  get_filename_component(shipped_laws "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../laws" ABSOLUTE)
  list(APPEND law_folders "${shipped_laws}")
  list(APPEND options --laws "${shipped_laws}")
  if(ARG_PROFILE)
    list(APPEND options --profile ${ARG_PROFILE})
  endif()

  set(sources "")
  set(include_folders "")
  foreach(association IN LISTS ARG_ASSOCIATIONS)
    if(NOT association MATCHES "^([A-Za-z0-9_]+)-[a-z0-9]+-[a-z0-9]+-[a-z]+$")
      message(FATAL_ERROR "elastogen_add_kernels(${target}): '${association}' is no association; "
        "write law-element-quadrature-split, as in stvk-hexa8-q8-none")
    endif()
    _elastogen_find_law(law_file ${CMAKE_MATCH_1} ${law_folders})
    string(REPLACE "-" "_" identifier ${association})
    # A folder for each: builds run in parallel, and a folder has one manifest.
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}/${identifier}")
    set(outputs "${folder}/${identifier}.h" "${folder}/${identifier}_tables.h"
      "${folder}/${identifier}_f64.cpp" "${folder}/${identifier}_f32.cpp")
    add_custom_command(OUTPUT ${outputs} BYPRODUCTS "${folder}/manifest.json"
      COMMAND ${generator} generate ${association} --out "${folder}" ${options}
      DEPENDS ${generator} "${law_file}"
      COMMENT "Generating kernels of ${association}"
      VERBATIM)
    # Compiled by way of the sources that include them, and made before those are compiled.
    set_source_files_properties(${outputs} PROPERTIES HEADER_FILE_ONLY ON)
    list(APPEND sources ${outputs})
    list(APPEND include_folders "${folder}")
  endforeach()

  _elastogen_kernel_library(${target} ASSOCIATIONS ${ARG_ASSOCIATIONS}
    PRECISIONS ${ARG_PRECISIONS} INSTRUCTION_SETS ${ARG_INSTRUCTION_SETS})
  target_sources(${target} PRIVATE ${sources})
  target_include_directories(${target} PUBLIC ${include_folders})
endfunction()

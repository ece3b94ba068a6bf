# elastogen_add_kernels(TARGET ASSOCIATIONS id... [LAWS folder...] [PROFILE name])
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
# The generator is ELASTOGEN_EXECUTABLE where set, else the target elastogen::elastogen, else the
# program in PATH. Shipped laws are those beside the folder that this file stands in, in the source
# tree as installed.
include_guard()

set(ELASTOGEN_EXECUTABLE "" CACHE FILEPATH
  "Generator; empty: the target elastogen::elastogen, or the program in PATH")

# The processor that builds is taken to be the one that runs; clear -march for others. A batch fills
# one 64-byte register, which gcc halves unless told.
set(_elastogen_flags -O3 -march=native -ffp-contract=fast -fno-math-errno -fno-trapping-math
  -Wno-psabi)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND _elastogen_flags -mprefer-vector-width=512)
endif()
set(ELASTOGEN_KERNEL_FLAGS "${_elastogen_flags}" CACHE STRING
  "Compiler options of generated kernels; used for nothing else")

# Makes `target`, a static library of kernel sources, compiled with ELASTOGEN_KERNEL_FLAGS.
function(_elastogen_kernel_library target)
  add_library(${target} STATIC ${ARGN})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE ${ELASTOGEN_KERNEL_FLAGS})
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
  cmake_parse_arguments(ARG "" "PROFILE" "ASSOCIATIONS;LAWS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "elastogen_add_kernels: unknown argument '${ARG_UNPARSED_ARGUMENTS}'; "
      "the call is elastogen_add_kernels(TARGET ASSOCIATIONS id... [LAWS folder...] "
      "[PROFILE name])")
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
    list(APPEND sources ${outputs})
    list(APPEND include_folders "${folder}")
  endforeach()

  _elastogen_kernel_library(${target} ${sources})
  target_include_directories(${target} PUBLIC ${include_folders})
endfunction()

# SPDX-License-Identifier: BSD-3-Clause
# Fuzz targets of histories: what is built step by step against what is built at once, the definition and exact checks. As the
# others, libFuzzer programs with DELONE_FUZZ, where the corpus is what they begin with:
#   build/fuzz/tests/fuzz/fuzz_histories -max_total_time=300 /tmp/corpus tests/fuzz/corpus/fuzz_histories
# Otherwise tests: the corpus is replayed, and then pseudo-random inputs.
set(inputs_fuzz_histories 200)
set(inputs_fuzz_histories_hulls 200)
foreach(fuzzer fuzz_histories fuzz_histories_hulls)
  if(DELONE_FUZZ)
    add_executable(${fuzzer} ${fuzzer}.cpp)
    target_compile_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
    target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
  else()
    add_executable(${fuzzer} ${fuzzer}.cpp replay.cpp)
    file(GLOB corpus CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${fuzzer}/*)
    add_test(NAME ${fuzzer} COMMAND ${fuzzer} --inputs ${inputs_${fuzzer}})
    add_test(NAME ${fuzzer}.corpus COMMAND ${fuzzer} ${corpus})
    set_tests_properties(${fuzzer} ${fuzzer}.corpus PROPERTIES LABELS fuzz TIMEOUT 600)
    add_dependencies(delone_memory_checked_tests ${fuzzer})
  endif()
  target_include_directories(${fuzzer} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_include_directories(${fuzzer} SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})
  target_link_libraries(${fuzzer} PRIVATE delone::delone delone_flags)
  add_dependencies(delone_fuzzers ${fuzzer})
endforeach()

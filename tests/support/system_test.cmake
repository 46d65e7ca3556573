# add_system_test(NAME SCRIPT [timeout]): a Python script that drives the built programs.
function(add_system_test name script)
  set(timeout 600)
  if(ARGC GREATER 2)
    set(timeout ${ARGV2})
  endif()
  add_test(NAME ${name} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/${script})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${timeout} SKIP_RETURN_CODE 77
    ENVIRONMENT "BERM_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY};BERM_ROOT=${CMAKE_SOURCE_DIR};PYTHONPATH=${CMAKE_SOURCE_DIR}/tests/support;PYTHONDONTWRITEBYTECODE=1")
endfunction()

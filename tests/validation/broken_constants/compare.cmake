# A gate passes as the program is, and fails with one constant broken.
execute_process(COMMAND ${WHOLE} ${CASE} ${RUNG} RESULT_VARIABLE whole)
execute_process(COMMAND ${BROKEN} ${CASE} ${RUNG} RESULT_VARIABLE broken)
if(NOT whole EQUAL 0)
  message(FATAL_ERROR "the gate does not pass with the constant as it is (exit code ${whole})")
endif()
if(NOT broken EQUAL 5)
  message(FATAL_ERROR "the gate did not notice the broken constant (exit code ${broken})")
endif()

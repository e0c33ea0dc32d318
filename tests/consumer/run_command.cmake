# run(<command>...): ends the test with what the command printed if it fails. `output` holds it
# otherwise.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nfailed with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Ends the test if the configuration told of what no user of Quadrel can mend.
function(check_configuration text)
  if(text MATCHES "PyImath")
    message(FATAL_ERROR "the configuration tells of PyImath:\n${text}")
  endif()
endfunction()

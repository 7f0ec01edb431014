# Writes a source that holds the commit of a folder, anew only if it is another one. Results that were taken since are no
# difference.   cmake -D source=FOLDER -D out=FILE -P
execute_process(COMMAND git -C ${source} rev-parse --short=8 HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${source} diff --quiet HEAD -- . ":!bench/results" RESULT_VARIABLE differs ERROR_QUIET)
if(NOT commit)
  set(commit unknown)  # a copy without its history
elseif(NOT differs EQUAL 0)
  string(APPEND commit -dirty)
endif()
file(CONFIGURE OUTPUT ${out} CONTENT "#include \"bench/table.h\"\n\nconst char* const tact::bench::kCommit = \"${commit}\";\n")

# Writes a source that holds the commit of a folder, anew only if it is another one.   cmake -D source=FOLDER -D out=FILE -P
execute_process(COMMAND git -C ${source} describe --always --dirty --abbrev=8 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)  # a copy without its history
endif()
file(CONFIGURE OUTPUT ${out} CONTENT "#include \"bench/table.h\"\n\nconst char* const tact::bench::kCommit = \"${commit}\";\n")

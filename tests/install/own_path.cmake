# The files below a folder that say where this was built: in the list `found`. A checkout in /gnomon is not
# meant by OWNER/gnomon or share/gnomon. As a control, a file of the build says it.
function(find_own_path source build folder found)
  string(REGEX REPLACE "([][+.*?^$(){}|\\])" "\\\\\\1" path "${source}")
  set(own_path "(^|[^[:alnum:]_./~-])${path}($|[^[:alnum:]_-])")
  execute_process(COMMAND grep --quiet --extended-regexp -e ${own_path} ${build}/CMakeCache.txt
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND grep --recursive --files-with-matches --extended-regexp -e ${own_path} ${folder}
                  OUTPUT_VARIABLE files)
  set(${found} "${files}" PARENT_SCOPE)
endfunction()

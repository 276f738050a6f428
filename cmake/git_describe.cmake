# Writes OUT, a header with the state of the git tree SOURCE, or "" outside of git. An unchanged header is
# not rewritten, so nothing is recompiled. cmake -DSOURCE=DIR -DOUT=FILE -P git_describe.cmake
set(described "")
# A tarball unpacked in another project's tree must not report that project's state.
if(EXISTS "${SOURCE}/.git")
  execute_process(COMMAND git -C "${SOURCE}" describe --always --tags --dirty
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUT}" CONTENT "#define VCARVE_GIT_DESCRIBE \"${described}\"\n")

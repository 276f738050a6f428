# Writes OUT, a header with the state of the git tree SOURCE, or with "" outside of git; only when it
# changed, so that nothing is compiled again. cmake -DSOURCE=DIR -DOUT=FILE -P git_describe.cmake
set(described "")
# A tarball unpacked inside another project's tree is not that project.
if(EXISTS "${SOURCE}/.git")
  execute_process(COMMAND git -C "${SOURCE}" describe --always --tags --dirty
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUT}" CONTENT "#define VCARVE_GIT_DESCRIBE \"${described}\"\n")

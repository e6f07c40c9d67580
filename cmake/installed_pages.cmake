# SPDX-License-Identifier: MIT
# Copies the pages of FROM into TO, without pictures (14 MB) and without links to files that are not installed.
file(REMOVE_RECURSE "${TO}")
file(GLOB pages "${FROM}/*.md")
foreach(page IN LISTS pages)
  get_filename_component(name "${page}" NAME)
  file(READ "${page}" text)
  string(REGEX REPLACE "\n!\\[[^\n]*\n" "\n" text "${text}")
  string(REPLACE "](../examples/render.c)" "](examples/render.c)" text "${text}")
  string(REGEX REPLACE "\\[([^]\n]*)\\]\\(\\.\\./[^)\n]*\\)" "\\1" text "${text}")
  file(WRITE "${TO}/${name}" "${text}")
endforeach()

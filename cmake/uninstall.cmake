# Removes what the last `cmake --install` of the build tree BUILD has installed, and the folders that are then empty.
# In /usr and /usr/local other folders than those of slipfront remain, because the system expects them.
if(NOT EXISTS ${BUILD}/install_manifest.txt)
  message(FATAL_ERROR "${BUILD}/install_manifest.txt is missing: nothing was installed from this build")
endif()
file(STRINGS ${BUILD}/install_manifest.txt files)
file(READ ${BUILD}/install_prefix.txt prefix)

set(folders "")
foreach(file IN LISTS files)
  file(REMOVE "$ENV{DESTDIR}${file}")
  cmake_path(GET file PARENT_PATH folder)
  if(file MATCHES "\\.py$")
    file(REMOVE_RECURSE "$ENV{DESTDIR}${folder}/__pycache__")  # Python has created it
  endif()
  cmake_path(IS_PREFIX prefix "${folder}" below)
  while(below AND NOT "${folder}" STREQUAL "${prefix}")
    list(APPEND folders "${folder}")
    cmake_path(GET folder PARENT_PATH folder)
  endwhile()
endforeach()

list(REMOVE_DUPLICATES folders)
list(SORT folders ORDER DESCENDING)  # each folder before those that contain it
if(prefix MATCHES "^/usr(/local)?/?$")
  list(FILTER folders INCLUDE REGEX "/slipfront(/|$)")
endif()
foreach(folder IN LISTS folders)
  file(GLOB content LIST_DIRECTORIES true "$ENV{DESTDIR}${folder}/*" "$ENV{DESTDIR}${folder}/.*")
  if(NOT content)
    file(REMOVE_RECURSE "$ENV{DESTDIR}${folder}")
  endif()
endforeach()
message(STATUS "slipfront is removed from $ENV{DESTDIR}${prefix}")

# unity_of_folders(TARGET [SEPARATE FILE...]) compiles the sources of a target that share a folder as one file, because
# reading the headers takes longer than compiling what follows them. So names in anonymous namespaces must differ within a
# folder. Sources with compile options of their own, and those named after SEPARATE, are compiled alone.
# -DSLIPFRONT_UNITY=OFF compiles each file alone.
function(unity_of_folders target)
  cmake_parse_arguments(PARSE_ARGV 1 unity "" "" SEPARATE)
  if(NOT SLIPFRONT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    if(NOT name IN_LIST unity_SEPARATE)
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
      string(REPLACE / _ group ${folder})
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

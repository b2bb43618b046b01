# SPDX-License-Identifier: BSD-3-Clause
# edgevo_embed_texts(TARGET FILE...)
# Compiles text files into TARGET: "assets/page.css" becomes `extern const char* const kPageCss` of namespace edgevo::assets,
# which the target declares in its own header. The next build picks up changes of the file.
# This file is also the script that generates the source: cmake -DFROM=... -DTO=... -DNAME=... -P EdgevoEmbed.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${FROM} text)
  file(WRITE ${TO} "namespace edgevo::assets {\nextern const char* const ${NAME};\nconst char* const ${NAME} = R\"embedded(${text})embedded\";\n}\n")
  return()
endif()

set(EDGEVO_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

# page.css -> kPageCss
function(edgevo_embedded_name file result)
  get_filename_component(words ${file} NAME)
  string(REGEX MATCHALL "[A-Za-z0-9]+" words ${words})
  set(name k)
  foreach(word IN LISTS words)
    string(SUBSTRING ${word} 0 1 first)
    string(SUBSTRING ${word} 1 -1 rest)
    string(TOUPPER ${first} first)
    string(APPEND name ${first}${rest})
  endforeach()
  set(${result} ${name} PARENT_SCOPE)
endfunction()

function(edgevo_embed_texts target)
  foreach(file IN LISTS ARGN)
    edgevo_embedded_name(${file} name)
    set(from ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    set(to ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
    add_custom_command(OUTPUT ${to} DEPENDS ${from} ${EDGEVO_EMBED_SCRIPT} VERBATIM
      COMMAND ${CMAKE_COMMAND} -DFROM=${from} -DTO=${to} -DNAME=${name} -P ${EDGEVO_EMBED_SCRIPT})
    target_sources(${target} PRIVATE ${to})
  endforeach()
endfunction()

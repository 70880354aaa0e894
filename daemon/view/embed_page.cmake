# Writes page_files.cpp: cmake -D OUTPUT=page_files.cpp -D FOLDER=page -P embed_page.cmake
set(types html text/html css text/css js text/javascript svg image/svg+xml)
file(GLOB names RELATIVE ${FOLDER} ${FOLDER}/*)
set(arrays "")
set(entries "")
foreach(name IN LISTS names)
  string(REGEX MATCH "[a-z]+$" extension ${name})
  list(FIND types ${extension} place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${name}: no content type for .${extension}")
  endif()
  math(EXPR place "${place} + 1")
  list(GET types ${place} type)
  string(MAKE_C_IDENTIFIER ${name} symbol)
  file(READ ${FOLDER}/${name} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char ${symbol}[] = {${bytes}};\n")
  string(APPEND entries "      {\"/${name}\", file(\"${type}\", ${symbol})},\n")
  if(name STREQUAL index.html)
    string(APPEND entries "      {\"/\", file(\"${type}\", ${symbol})},\n")
  endif()
endforeach()
file(WRITE ${OUTPUT} "#include \"daemon/view/page_files.hpp\"

namespace swiftlet {
namespace {
${arrays}
template <std::size_t size>
PageFile file(const char* type, const unsigned char (&bytes)[size]) {
  return {type, {reinterpret_cast<const char*>(bytes), size}};
}
}  // namespace

PageFiles page_files() {
  return {
${entries}  };
}
}  // namespace swiftlet
")

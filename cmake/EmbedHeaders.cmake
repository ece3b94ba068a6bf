# Script: writes OUTPUT, the C++ source of selector/jit/embedded_headers.h, from the HEADERS (a
# list of paths relative to ROOT).
#   cmake -DROOT=... -DHEADERS=... -DOUTPUT=... -P EmbedHeaders.cmake
set(entries "")
foreach(header IN LISTS HEADERS)
  file(READ "${ROOT}/${header}" text)
  string(APPEND entries "    {\"${header}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by cmake/EmbedHeaders.cmake; edit the headers in runtime/ instead.
#include \"selector/jit/embedded_headers.h\"

namespace elastogen::selector {
namespace {

constexpr EmbeddedHeader headers[] = {
${entries}};

}  // namespace

std::span<const EmbeddedHeader> embedded_headers() { return headers; }

}  // namespace elastogen::selector
")

# Script: writes OUTPUT, the C++ source of symgen::generator_fingerprint(): a hash of every source
# and header below FOLDER. There is no list to forget a file in.
#   cmake -DFOLDER=... -DOUTPUT=... -P GeneratorFingerprint.cmake
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*.cpp ${FOLDER}/*.h)
list(SORT files)
set(digests "")
foreach(file IN LISTS files)
  file(SHA256 ${FOLDER}/${file} digest)
  string(APPEND digests "${file} ${digest}\n")
endforeach()
string(SHA256 fingerprint "${digests}")
file(WRITE "${OUTPUT}" "// Made by cmake/GeneratorFingerprint.cmake.
#include \"symgen/pipeline.h\"

std::string elastogen::symgen::generator_fingerprint() {
  return \"${fingerprint}\";
}
")

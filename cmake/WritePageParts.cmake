# cmake -D parts=NAME=FILE|NAME=FILE... -D source=FILE -P WritePageParts.cmake: writes the texts of
# pages (HTML, styles, scripts) as a C++ source that knows them by name. A part without a file is
# empty: without three.js pages say that they have no 3D view.
string(REPLACE "|" ";" part_list "${parts}")
set(entries "")
foreach(part IN LISTS part_list)
  string(FIND "${part}" "=" cut)
  string(SUBSTRING "${part}" 0 ${cut} name)
  math(EXPR begin "${cut} + 1")
  string(SUBSTRING "${part}" ${begin} -1 file)
  set(text "")
  if(file)
    file(READ "${file}" text)
  endif()
  string(FIND "${text}" ")page\"" delimiter)
  if(NOT delimiter EQUAL -1)
    message(FATAL_ERROR "${file}: holds )page\", which ends a text in C++")
  endif()
  string(APPEND entries "    {\"${name}\", R\"page(${text})page\"},\n")
endforeach()

file(WRITE "${source}" "#include \"apps/page_parts.h\"

namespace curvefusion {

const std::vector<PagePart>& PageParts() {
  static const std::vector<PagePart> parts = {
${entries}  };
  return parts;
}

}  // namespace curvefusion
")

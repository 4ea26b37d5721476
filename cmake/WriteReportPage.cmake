# cmake -D folder=DIR -D three=FILE -D source=FILE -P WriteReportPage.cmake: puts style, scripts and
# three.js into the page of a result and writes it, cut where its data go, as a C++ source. Without
# three.js (an empty name) the page says that it has no 3D view.
set(three_text "")
if(three)
  file(READ "${three}" three_text)
endif()
file(READ "${folder}/page.html" page)
foreach(name style.css orbit.js tubes.js viewer.js page.js)
  file(READ "${folder}/${name}" text)
  string(REPLACE "{{${name}}}" "${text}" page "${page}")
endforeach()
string(REPLACE "{{three.js}}" "${three_text}" page "${page}")

string(FIND "${page}" "{{data}}" cut)
string(FIND "${page}" "{{data}}" last_cut REVERSE)
if(cut EQUAL -1 OR NOT cut EQUAL last_cut)
  message(FATAL_ERROR "${folder}/page.html: needs {{data}} once")
endif()
math(EXPR after "${cut} + 8")
string(SUBSTRING "${page}" 0 ${cut} before_data)
string(SUBSTRING "${page}" ${after} -1 after_data)
foreach(part before_data after_data)
  string(FIND "${${part}}" ")page\"" delimiter)
  if(NOT delimiter EQUAL -1)
    message(FATAL_ERROR "${folder}: a file holds )page\", which ends a text in C++")
  endif()
endforeach()

file(WRITE "${source}" "#include \"apps/report_page_text.h\"

namespace curvefusion {

const std::string_view kReportPageBeforeData = R\"page(${before_data})page\";
const std::string_view kReportPageAfterData = R\"page(${after_data})page\";

}  // namespace curvefusion
")

// What a file is that is no table of text.
#pragma once

#include <string>
#include <string_view>

namespace kinesphere::program {

/// True for the names of a message of orbital elements (OMM, CCSDS 502.0-B) as keywords, CSV or JSON.
bool has_orbital_elements(std::string_view beginning);
/// True for lists of values, one for each name, such as {"time":[0,1],"x":[2,3]}.
bool is_columnar_json(std::string_view beginning);
/// True for a document of CZML, for CesiumJS.
bool is_czml(std::string_view beginning);

/// Returns the name of the outermost element of XML, without a prefix; empty for other text, and where it
/// comes later than this beginning.
std::string_view root_element(std::string_view text);

/// Returns what the file is and what to do, for the end of a sentence: "a zip archive: unpack it first".
/// Empty for a text that may be a table. `beginning` is that of the file; a few hundred bytes are enough.
std::string other_file_kind(std::string_view beginning);

}  // namespace kinesphere::program

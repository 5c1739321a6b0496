// Encodings of text from instruments and old editors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pulvis {

// Length of the UTF-8 sequence at the start of `text`, 0 if it is not one (RFC 3629: no surrogates,
// no overlong forms, nothing above U+10FFFF).
std::size_t sequence_length(std::string_view text);

// The text itself if it is UTF-8; otherwise it is read as Latin-1, which has the same µ, ° and ² as Windows-1252.
std::string as_utf8(std::string text);

bool is_utf16(std::string_view text);  // by its byte order mark

// The meaning in Latin-1 of a byte that is not UTF-8: "0xB5, which is 'µ' in Latin-1".
std::string latin1_text(char byte);

}  // namespace pulvis

// Text as it comes from instruments and old editors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pulvis {

// Length of the UTF-8 sequence at the front of `text`, 0 when it is none (RFC 3629: no surrogates,
// no overlong forms, nothing above U+10FFFF).
std::size_t sequence_length(std::string_view text);

// The text itself where it is UTF-8; otherwise it is taken for Latin-1, whose µ, ° and ² are those of Windows, too.
std::string as_utf8(std::string text);

bool is_utf16(std::string_view text);  // by its byte order mark

// What a byte that is no UTF-8 stands for in Latin-1: "0xB5, which is 'µ' in Latin-1".
std::string latin1_text(char byte);

}  // namespace pulvis

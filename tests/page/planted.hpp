// The errors that the checks of this room are shown to catch, one switch each.
#pragma once

namespace quadrel::planted {

enum class PageError {
    wrong_byte,      ///< a byte of the embedded data is another
    wrong_value,     ///< a bit of one value is another, and the page tells the other
    wrong_verdict,   ///< a value that is not legal counts as one that is
    wrong_code,      ///< one code of a target is one off
    wrong_language,  ///< a snippet in another language than its file's
    narrowed_range,  ///< an end of a range that is kept further inside than it is
    open_element,    ///< a channel's name ends the element that holds the data
};

}  // namespace quadrel::planted

// Memory that ran out while a library read a file says nothing about the file.
#pragma once

#include <exception>
#include <new>
#include <string_view>

namespace quadrel {

/// Whether a library's message is that of an allocation, or of a thread that had no memory to start
/// with: some keep the words of an exception and lose its type. Words that a quotation mark follows
/// are a name from the file.
inline bool says_out_of_memory(std::string_view message) {
    for (const std::string_view words :
         {"std::bad_alloc", "std::bad_array_new_length", "annot allocate memory", "ut of memory",
          "nable to allocate", "failed to map segment", "Resource temporarily unavailable"}) {
        const std::size_t found = message.rfind(words);
        if (found == message.npos) continue;
        if (message.find_first_of("\"'", found + words.size()) == message.npos) return true;
    }
    return false;
}

/// Throws std::bad_alloc if that is what `error` is or was; to be called first where anything that
/// a library throws becomes an InputError.
inline void rethrow_out_of_memory(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr || says_out_of_memory(error.what()))
        throw std::bad_alloc();
}

}  // namespace quadrel

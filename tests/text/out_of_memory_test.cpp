// Which messages of libraries are those of memory that ran out.
#include "text/out_of_memory.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace quadrel {
namespace {

using Judge = std::function<bool(std::string_view)>;

/// Words of a file that a message quotes are no words of the library.
testing::AssertionResult tells_apart(const Judge& says) {
    for (const char* message :
         {"std::bad_alloc", "Cannot read image file \"a.exr\". std::bad_alloc",
          "Unable to allocate 4096 bytes", "a.so: failed to map segment from shared object",
          "fork: Resource temporarily unavailable"})
        if (!says(message)) return testing::AssertionFailure() << message;
    for (const char* message : {"", "Unexpected end of file",
                                "The y subsampling factor for the \"std::bad_alloc\" channel",
                                "cannot open 'out of memory'"})
        if (says(message)) return testing::AssertionFailure() << message;
    return testing::AssertionSuccess();
}

bool says_anywhere(std::string_view message) {
    return message.find("std::bad_alloc") != message.npos || says_out_of_memory(message);
}

TEST(OutOfMemory, IsToldFromNamesInMessages) {
    EXPECT_TRUE(tells_apart(says_out_of_memory));
    EXPECT_FALSE(tells_apart(says_anywhere));
    EXPECT_FALSE(tells_apart([](std::string_view) { return false; }));
}

TEST(OutOfMemory, IsThrownAgainAsItself) {
    EXPECT_THROW(rethrow_out_of_memory(std::runtime_error("std::bad_alloc")), std::bad_alloc);
    EXPECT_THROW(rethrow_out_of_memory(std::bad_alloc()), std::bad_alloc);
    EXPECT_NO_THROW(rethrow_out_of_memory(std::runtime_error("damaged")));
}

}  // namespace
}  // namespace quadrel

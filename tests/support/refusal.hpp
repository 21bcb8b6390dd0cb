#pragma once

#include <stdexcept>
#include <string>

namespace ljus_test {

/// The sentence with which a call is refused; empty if it is not.
template <typename Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

} // namespace ljus_test

/// \file object_test.cpp
/// \brief The numbers of shapes and materials.

#include "ljus/scene/object.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>

using namespace ljus;

TEST_CASE("object: numbers are equal when type and index are") {
    CHECK(MaterialId{1, 2} == MaterialId{1, 2});
    CHECK(MaterialId{1, 2} != MaterialId{2, 1});
    CHECK(ObjectId{0, 3} == ObjectId{0, 3});
    CHECK(ObjectId{0, 3} != ObjectId{0, 4});
    CHECK(ObjectId{0, 3} != ObjectId{1, 3});
}

TEST_CASE("object: without more said it neither emits nor is inside out") {
    const detail::ObjectT<float> object{.material = {1, 2}};
    CHECK(is_black(object.emission));
    CHECK_FALSE(object.inside_out);
    CHECK(object.light == std::numeric_limits<std::uint32_t>::max());
}

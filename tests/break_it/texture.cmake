# An image upside down.
ljus_break_it(NAME texture-upside-down HEADER image/texture.hpp TEST texture
    FROM "(T(1) - repeat(uv.y)) * T(image.height)"
    TO   "repeat(uv.y) * T(image.height)"
    CASES "texture: an image*")

# Pixels by their corners in place of their middles.
ljus_break_it(NAME texture-half-pixel HEADER image/texture.hpp TEST texture
    FROM "const T x = repeat(uv.x) * T(image.width) - T(0.5);"
    TO   "const T x = repeat(uv.x) * T(image.width);"
    CASES "texture: an image*")

# Rounded towards zero: the fields around the origin are twice as wide.
ljus_break_it(NAME texture-towards-zero HEADER image/texture.hpp TEST texture
    FROM "std::floor(uv.x * T(checker.columns))"
    TO   "std::trunc(uv.x * T(checker.columns))"
    CASES "texture: a chessboard*")

# The texture's colour in place of the product.
ljus_break_it(NAME textured-product HEADER materials/textured.hpp TEST texture
    FROM "base.albedo *= color;
    else if constexpr (requires { base.reflectance *= color; })"
    TO   "base.albedo = color;
    else if constexpr (requires { base.reflectance *= color; })"
    CASES "texture: the hook*")

# The hook forgotten: every place looks like the base.
ljus_break_it(NAME textured-hook HEADER path/vertex.hpp TEST texture
    FROM "if constexpr (Material<std::remove_cvref_t<Here>>)"
    TO   "if constexpr (!Material<std::remove_cvref_t<Here>>)"
    CASES "texture: in a white furnace*")

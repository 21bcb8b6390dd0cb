# The second branch at glass is grown from the first: twice the reflection.
ljus_break_it(NAME whitted-branch HEADER render/whitted.hpp TEST whitted
    FROM "grow(*other);"
    TO   "grow(path);"
    CASES "whitted: a ball of glass over*")

# The depth counts one turn too many.
ljus_break_it(NAME whitted-depth HEADER render/whitted.hpp TEST whitted
    FROM "if (path.depth > tracer.settings().max_depth) {"
    TO   "if (path.depth > tracer.settings().max_depth + 1) {"
    CASES "whitted: one ball of glass*")

# Matt surfaces send their light on as well: L D D E.
ljus_break_it(NAME whitted-diffuse HEADER render/whitted.hpp TEST whitted
    FROM "Lobes::specular, context.stream);"
    TO   "Lobes::all, context.stream);"
    CASES "whitted: every path*")

# A lamp made of a sphere lights from any point of its cone's rim.
ljus_break_it(NAME whitted-middle HEADER geometry/sphere.hpp TEST whitted
    FROM "return Vec2T<T>{T(0)};"
    TO   "return Vec2T<T>{T(1)};"
    CASES "whitted: a lamp with a size*")

# The light that a surface finds is not multiplied by what the way to the eye lets through.
ljus_break_it(NAME whitted-share HEADER render/whitted.hpp TEST whitted
    FROM "const RgbT<T> throughput = path.throughput; // of this vertex"
    TO   "const RgbT<T> throughput{T(1)};"
    CASES "whitted: a mirror over*")

# Shadow rays see through everything.
ljus_break_it(NAME whitted-shadow HEADER path/direct_light.hpp TEST whitted
    FROM "if (is_black(visible)) return share;"
    TO   "if (!is_black(visible) || is_black(visible)) return {share.sent, share.sent};"
    CASES "whitted: a mirror over*")

# Rays of the tree see the whole square.
ljus_break_it(NAME cut_out-nearest HEADER scene/world.hpp TEST cut_out
    FROM "return detail::hit_on<Compute>(world, world.ids()[slot], rest, shape);"
    TO   "return detail::hit_of<Compute>(rest, shape);"
    CASES "cut-out: the tree*")

# Shadow rays see the whole square.
ljus_break_it(NAME cut_out-shadow HEADER scene/world.hpp TEST cut_out
    FROM "return detail::meets_object<Compute>(world, world.ids()[slot], ray, shape);"
    TO   "return detail::is_met<Compute>(ray, shape);"
    CASES "cut-out: the tree*")

# So do those of a scene without a tree.
ljus_break_it(NAME cut_out-shadow-plain HEADER scene/world.hpp TEST cut_out
    FROM "if (detail::meets_object<Compute>(world, id, ray, shape)) return true;"
    TO   "if (detail::is_met<Compute>(ray, shape)) return true;"
    CASES "cut-out: the shadow*")

# All shapes have the holes of the first one.
ljus_break_it(NAME cut_out-shadow-number HEADER scene/world.hpp TEST cut_out
    FROM "static_cast<std::uint32_t>(&shape - shapes.data())"
    TO   "static_cast<std::uint32_t>(0 * (&shape - shapes.data()))"
    CASES "cut-out: the tree*")

# Behind a hole nothing of the same shape is looked for.
ljus_break_it(NAME cut_out-behind HEADER scene/world.hpp TEST cut_out
    FROM "ray.t_min = std::nextafter(hit->t, std::numeric_limits<T>::infinity());"
    TO   "break;"
    CASES "cut-out: rays go*")

# A leaf on the floor covers the floor in its holes.
ljus_break_it(NAME cut_out-contact HEADER scene/world.hpp TEST cut_out
    FROM "return hit_on<Compute>(world, other.object, near, shape);"
    TO   "return hit_of<Compute>(near, shape);"
    CASES "cut-out: a leaf that lies*")

# Open where the mask is solid.
ljus_break_it(NAME cut_out-inverted HEADER materials/cut_out.hpp TEST cut_out
    FROM "position, uv).x) < cut.texture.cutoff"
    TO   "position, uv).x) > cut.texture.cutoff"
    CASES "cut-out: the shadow*")

# Of two masks the inner one is forgotten.
ljus_break_it(NAME cut_out-inner HEADER materials/cut_out.hpp TEST cut_out
    FROM "if (is_open(cut.base, position, uv)) return true;"
    TO   ""
    CASES "cut-out: a camera*")

# A lamp shines out of its holes.
ljus_break_it(NAME cut_out-lamp HEADER scene/scene.hpp TEST cut_out
    FROM "require(!CutOutMaterial<B> || is_black(all)"
    TO   "require(true || is_black(all)"
    CASES "cut-out: lamps*")

# Half open is taken for a hole.
ljus_break_it(NAME cut_out-number HEADER materials/material.hpp TEST cut_out
    FROM "std::same_as<bool>"
    TO   "std::convertible_to<bool>"
    CASES "cut-out: a camera*" COMPILED)

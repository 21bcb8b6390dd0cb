# The area of a belt forgotten: a density that is none.
ljus_break_it(NAME hemisphere_sampling-belt HEADER math/sampling.hpp
    TEST hemisphere_sampling
    FROM "inv_pi * inv_pi / std::sqrt(d.x * d.x + d.y * d.y)"
    TO   "inv_pi * inv_pi"
    CASES "hemisphere_sampling: a constant sky*")

# The inclination over the whole circle: half of the directions go into the ground.
ljus_break_it(NAME hemisphere_sampling-quarter HEADER math/sampling.hpp
    TEST hemisphere_sampling
    FROM "std::sin((T(1) - u.x) * pi / T(2))"
    TO   "std::cos(u.x * pi)"
    CASES "hemisphere_sampling: no u*")

# The pdf forgotten: what is left is the cosine-weighted one.
ljus_break_it(NAME hemisphere_sampling-forgotten HEADER math/sampling.hpp
    TEST hemisphere_sampling
    FROM "inv_pi * inv_pi / std::sqrt(d.x * d.x + d.y * d.y)"
    TO   "inv_pi * d.z"
    CASES "hemisphere_sampling: a bright lobe*")

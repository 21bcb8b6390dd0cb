# One photon is enough to be sure.
ljus_break_it(NAME shadow-photons-needed HEADER photons/shadow_verdict.hpp TEST shadow_photons
    FROM "if (direct + shadow < needed) return Verdict::unknown;"
    TO   "if (direct + shadow < 1) return Verdict::unknown; (void)needed;"
    CASES "shadow photons: how many*")

# The number that is needed by the wrong logarithm: of tau in place of 1 - tau.
ljus_break_it(NAME shadow-photons-logarithm HEADER photons/shadow_verdict.hpp TEST shadow_photons
    FROM "std::log1p(-tau)"
    TO   "std::log(tau)"
    CASES "shadow photons: how many*")

# The report's "nearly none" for every rule.
ljus_break_it(NAME shadow-photons-few HEADER photons/shadow_verdict.hpp TEST shadow_photons
    FROM "const std::uint64_t few = rule == SkipRule::report ? report_ratio : 0;"
    TO   "const std::uint64_t few = rule == SkipRule::report ? report_ratio : 20;"
    CASES "shadow photons: how many*")

# Lit and in shadow are told from each other by the wrong kind.
ljus_break_it(NAME shadow-photons-kinds HEADER photons/detail/verdict_bits.hpp TEST shadow_photons
    FROM "{64 * brick + at->in_brick(), photon.kind == PhotonKind::shadow}"
    TO   "{64 * brick + at->in_brick(), photon.kind == PhotonKind::direct}"
    CASES "shadow photons: the grid says*")

# Photons of all lamps together, as the report has it.
ljus_break_it(NAME shadow-photons-lights HEADER photons/detail/verdict_bits.hpp TEST shadow_photons
    FROM "const bool together = skip.rule == SkipRule::report;"
    TO   "const bool together = true;"
    CASES "shadow photons: the report asks*,shadow photons: extremes")

# The normal alone decides which way a side faces, and both sides of a wall are one.
ljus_break_it(NAME shadow-photons-side HEADER photons/shadow_verdict.hpp TEST shadow_photons
    FROM "return (n[axis] < 0) == (side < 0) ? axis : axis + 3;"
    TO   "(void)side; return n[axis] < 0 ? axis + 3 : axis;"
    CASES "shadow photons: which way*,shadow photons: the penumbra*")

# Only the cell itself is asked: a shadow photon next door goes unheard.
ljus_break_it(NAME shadow-photons-neighbors HEADER photons/detail/verdict_bits.hpp TEST shadow_photons
    FROM "sums[i] += sums[i + step] + sums[i + 2 * step];"
    TO   "sums[i] = sums[i + step];"
    CASES "shadow photons: the grid says*")

# The bricks around are forgotten: edges of bricks know half of their photons.
ljus_break_it(NAME shadow-photons-bricks HEADER photons/detail/verdict_bits.hpp TEST shadow_photons
    FROM "if (other == BrickTable::none) continue;"
    TO   "if (other == BrickTable::none || n != 13) continue;"
    CASES "shadow photons: the grid says*")

# A coarse cell speaks before the fine one has been asked, and cells of another place.
ljus_break_it(NAME shadow-photons-coarse HEADER photons/verdict_grid.hpp TEST shadow_photons
    FROM "(first.y + (cell >> 2 & 3)) / times,"
    TO   "(first.y + (cell & 3)) / times,"
    CASES "shadow photons: the grid says*")

# A ray that is skipped skips the light, too.
ljus_break_it(NAME shadow-photons-dark HEADER path/direct_light.hpp TEST shadow_photons
    FROM "++counts.skipped_rays;"
    TO   "++counts.skipped_rays; return share;"
    CASES "shadow photons: what is known*")

# What is in shadow is taken to be lit.
ljus_break_it(NAME shadow-photons-verdict HEADER photons/verdict_grid.hpp TEST shadow_photons
    FROM "lit + 2 * shadow"
    TO   "lit + shadow"
    CASES "shadow photons: the grid says*,shadow photons: fewer*")

# Only the brick of an indirect photon is made: beside it all is called dark.
ljus_break_it(NAME shadow-photons-near HEADER photons/detail/verdict_bits.hpp TEST shadow_photons
    FROM "for (int corner = 0; indirect && corner < 8; ++corner)"
    TO   "for (int corner = 0; indirect && corner < 0; ++corner)"
    CASES "shadow photons: no indirect*")

# Photons by power although only shadow rays are asked about.
ljus_break_it(NAME shadow-photons-equal HEADER photons/tracing.hpp TEST shadow_photons
    FROM "for (std::size_t i = 0; pass.equal_lights && i < lights; ++i)"
    TO   "for (std::size_t i = 0; pass.equal_lights && i + 1 < 1; ++i)"
    CASES "shadow photons: the report asks*")

# Walls lie on the border of two layers of cells, and rounding shares their photons out.
ljus_break_it(NAME verdict_grid-border HEADER photons/verdict_grid.hpp
    TEST shadow_photons
    FROM "T(32.5) * length"
    TO   "T(32) * length"
    CASES "shadow photons: a wall lies*")

# As many indirect photons are asked for as direct ones.
ljus_break_it(NAME shadow-photons-one HEADER photons/detail/verdict_bits.hpp
    TEST shadow_photons
    FROM "indirect ? 1 : photons_needed(skip)"
    TO   "photons_needed(skip)"
    CASES "shadow photons: one indirect*")

# The counts of the first light alone are taken back: those of the others stay for the
# lights after them.
ljus_break_it(NAME shadow-photons-leftover HEADER photons/detail/verdict_bits.hpp
    TEST shadow_photons
    FROM "for (const Witness& one : found[list]) counts[one.where] = 0;"
    TO   "for (const Witness& one : found[0]) counts[one.where] = 0;"
    CASES "shadow photons: in one place each light*")

# A radius that shrinks so fast that the noise never does.
ljus_break_it(NAME progressive-radius HEADER render/progressive.hpp TEST progressive
    FROM "(n + 1 + state.alpha) / (n + 2)"
    TO   "(n + 1) / (n + 2)"
    CASES "progressive: the radius*")

# The sum of the passes as their mean.
ljus_break_it(NAME progressive-mean HEADER render/progressive.hpp TEST progressive
    FROM "state.sum.pixels[p] / double(state.passes)"
    TO   "state.sum.pixels[p]"
    CASES "progressive: the mean*")

# The same photons in each pass: nothing to average.
ljus_break_it(NAME progressive-photons HEADER render/progressive.hpp TEST progressive
    FROM "settings.caustics.iteration = settings.general.iteration = number;"
    TO   ""
    CASES "progressive: each pass has photons*")

# The same camera rays in each pass.
ljus_break_it(NAME progressive-camera HEADER render/progressive.hpp TEST progressive
    FROM "picture.seed = mix_bits(mix_bits(picture.seed) + number);"
    TO   ""
    CASES "progressive: both radii*")

# Only one of the two radii shrinks.
ljus_break_it(NAME progressive-general HEADER render/progressive.hpp TEST progressive
    FROM "settings.general_estimate.radius *= static_cast<float>(scale);"
    TO   ""
    CASES "progressive: both radii*")
ljus_break_it(NAME progressive-caustics HEADER render/progressive.hpp TEST progressive
    FROM "settings.caustics_estimate.radius *= static_cast<float>(scale);"
    TO   ""
    CASES "progressive: both radii*")

# A pass that was stopped counts as if it were whole.
ljus_break_it(NAME progressive-stopped HEADER render/progressive.hpp TEST progressive
    FROM "if (!rendered.complete) return false;"
    TO   "if (!rendered.complete && rendered.image.pixels.empty()) return false;"
    CASES "progressive: both radii*")

# The distance from the old mean, squared, as if it were that from the new one.
ljus_break_it(NAME progressive-squares HEADER render/progressive.hpp TEST progressive
    FROM "away * away * (n / (n + 1))"
    TO   "away * away"
    CASES "progressive: the estimated error*")

# The scatter of one pass as if it were that of the mean.
ljus_break_it(NAME progressive-error HEADER render/progressive.hpp TEST progressive
    FROM "(n * (n - 1))"
    TO   "(n - 1)"
    CASES "progressive: the estimated error*")

# Any picture is gone on with.
ljus_break_it(NAME progressive-first HEADER render/progressive.hpp TEST progressive
    FROM "detail::hash_of(again.image) == state.first_pass"
    TO   "true"
    CASES "progressive: what cannot be*")

# A damaged checkpoint is believed.
ljus_break_it(NAME progressive-checksum HEADER io/binary_file.hpp TEST progressive
    FROM "checksum != detail::checksum(file.bytes)"
    TO   "false"
    CASES "progressive: a checkpoint*")

# The older checkpoint is written over: a kill at that moment leaves half of one.
ljus_break_it(NAME progressive-in-place HEADER io/progressive_file.hpp TEST progressive
    FROM "save_file(path, bytes);"
    TO   "std::FILE* const f = std::fopen(path.c_str(), \"wb\"); std::fwrite(bytes.data(), 1, bytes.size(), f); std::fclose(f);"
    CASES "progressive: killed*")

# A radius that each pass would choose anew, and that never shrinks.
ljus_break_it(NAME progressive-chosen HEADER render/progressive.hpp TEST progressive
    FROM "require_positive(\"caustics_estimate.radius\", settings.caustics_estimate.radius);"
    TO   ""
    CASES "progressive: radii and shares*")

# What the pilot has found is forgotten.
ljus_break_it(NAME progressive-shares HEADER render/photon_mapping.hpp TEST progressive
    FROM "settings_.caustics.shares = caustic_shares(world.get(), settings_);"
    TO   "(void)caustic_shares(world.get(), settings_);"
    CASES "progressive: radii and shares*")

# The general map's photons are the same in each pass.
ljus_break_it(NAME progressive-general-photons HEADER render/progressive.hpp
    TEST progressive
    FROM "settings.caustics.iteration = settings.general.iteration = number;"
    TO   "settings.caustics.iteration = number;"
    CASES "progressive: each pass has photons*")

# A checkpoint forgets what its picture is.
ljus_break_it(NAME progressive-picture HEADER io/progressive_file.hpp TEST progressive
    FROM "bytes.insert(bytes.end(), state.picture.begin(), state.picture.end());"
    TO   "bytes.resize(bytes.size() + state.picture.size());"
    CASES "progressive: a checkpoint*")

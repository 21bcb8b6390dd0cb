# The report's roulette: a survivor is not divided by its probability, and what the
# surface absorbs is lost twice.
ljus_break_it(NAME roulette-uncompensated HEADER photons/photon_path.hpp TEST photon
    FROM "const RgbT<T> survivor = reflected / probability;"
    TO   "const RgbT<T> survivor = reflected;"
    CASES "photon: roulette changes no mean*")

# A probability from one channel: a photon that turns blue always dies.
ljus_break_it(NAME roulette-one-channel HEADER photons/photon_path.hpp TEST photon
    FROM "max_component(reflected) / max_component(flux)"
    TO   "reflected.x / flux.x"
    CASES "photon: what survives*")

# The other way round: u >= p survives.
ljus_break_it(NAME roulette-turned HEADER photons/photon_path.hpp TEST photon
    FROM "if (!(u < probability))"
    TO   "if (u < probability)"
    CASES "photon: roulette*")

# An account that forgets what was absorbed.
ljus_break_it(NAME roulette-audit HEADER photons/photon_path.hpp TEST photon
    FROM "audit.absorbed += RgbT<double>(flux) - RgbT<double>(reflected);"
    TO   ""
    CASES "photon: at each surface*")

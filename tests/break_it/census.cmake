# Shadow photons counted as light.
ljus_break_it(NAME census-shadow HEADER inspect/census.hpp TEST census
    FROM "PhotonKind::caustic, PhotonKind::indirect}"
    TO   "PhotonKind::caustic, PhotonKind::indirect, PhotonKind::shadow}"
    CASES "census: kinds*")

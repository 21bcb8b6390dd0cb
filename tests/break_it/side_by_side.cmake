# Only the first class is told where a path begins.
ljus_break_it(NAME class-means-begin HEADER path/light_transport.hpp
    TEST side_by_side
    FROM "for (auto& log : logs) log.begin();"
    TO   "if (!logs.empty()) logs.front().begin();"
    CASES "side_by_side: classes*")

# The mean over pixels instead of over rays: a picture with four rays is four times bright.
ljus_break_it(NAME class-means-rays HEADER inspect/class_means.hpp TEST side_by_side
    FROM "double(picture.width) * picture.height * picture.samples;"
    TO   "double(picture.width) * picture.height;"
    CASES "side_by_side: classes*")

# The map seen directly shows direct photons as well: shadow rays have brought them.
ljus_break_it(NAME photon-mapping-direct-twice HEADER render/photon_mapping.hpp
    TEST side_by_side
    FROM "one_kind(PhotonKind::indirect)));"
    TO   "light_kinds));"
    CASES "side_by_side: the matt room*")


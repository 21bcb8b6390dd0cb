# Translated before it is turned.
ljus_break_it(NAME placement-order HEADER geometry/placement.hpp TEST placement
    FROM "return Vec3T<T>(matrix_of(placement.rotate) * scaled +
                    glm::dvec3(placement.translate));"
    TO   "return Vec3T<T>(matrix_of(placement.rotate) * (scaled +
                    glm::dvec3(placement.translate)));"
    CASES "placement: scaling comes first*")

# Normals are scaled like edges.
ljus_break_it(NAME placement-normal HEADER geometry/placement.hpp TEST placement
    FROM "glm::dvec3(normal) / glm::dvec3(placement.scale)"
    TO   "glm::dvec3(normal) * glm::dvec3(placement.scale)"
    CASES "placement: normals*")

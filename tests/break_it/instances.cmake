# The inverse is not transposed.
ljus_break_it(NAME instances-normal HEADER math/affine.hpp TEST instances
    FROM "return {glm::dot(inverse[0], n), glm::dot(inverse[1], n), glm::dot(inverse[2], n)};"
    TO   "return transform_vector(inverse, n);"
    CASES "instances: a map of a mesh*")

# The direction at the mesh has unit length, and t another unit than in the scene.
ljus_break_it(NAME instances-unit HEADER accel/instances.hpp TEST instances
    FROM "Vec3T<T>(transform_vector(back, Wide(ray.direction))),"
    TO   "Vec3T<T>(glm::normalize(transform_vector(back, Wide(ray.direction)))),"
    CASES "instances: a map of a mesh*")

# A mesh in a mirror is turned inside out.
ljus_break_it(NAME instances-mirror HEADER accel/instances.hpp TEST instances
    FROM "determinant_of(inverse_) < Wide(0)"
    TO   "false"
    CASES "instances: a map of a mesh*")

# The rounding of the ray at the mesh is forgotten.
ljus_break_it(NAME instances-rounding HEADER accel/instances.hpp TEST instances
    FROM "at_mesh(local.error + rounding_bound<T>(4) * reach)"
    TO   "at_mesh(0)"
    CASES "instances: a surface does not*")

# And where a shadow ray ends.
ljus_break_it(NAME instances-shadow HEADER accel/instances.hpp TEST instances
    FROM "point.error += Vec3T<T>("
    TO   "point.error += T(0) * Vec3T<T>("
    CASES "instances: a surface does not*")

# A stretched lamp is brighter where it was stretched.
ljus_break_it(NAME instances-areas HEADER accel/instances.hpp TEST instances
    FROM "if (instance.scale() > 0) return {};"
    TO   "return {};"
    CASES "instances: points are uniform*")

# The area is that of the mesh.
ljus_break_it(NAME instances-area HEADER accel/instances.hpp TEST instances
    FROM "double(scale_ * scale_) *"
    TO   "1.0 *"
    CASES "instances: points are uniform*")

# A moving instance is where it was at first.
ljus_break_it(NAME instances-moving HEADER accel/instances.hpp TEST instances
    FROM "-transform_vector(moved.inverse_, Vec3T<Wide>(moved.place_[3]));"
    TO   "instance.inverse_[3];"
    CASES "instances: one moves*")

# The normals of a moving mesh are those of its triangles.
ljus_break_it(NAME instances-moving-normal HEADER geometry/moving.hpp TEST instances
    FROM "return shading_normal(moving.shape, hit, geometric);"
    TO   "return geometric;"
    CASES "instances: one moves*")

# Only the middle of a turned ball is within its box.
ljus_break_it(NAME instances-box HEADER accel/instances.hpp TEST instances
    FROM "glm::sqrt(map[0] * map[0] + map[1] * map[1] + map[2] * map[2])"
    TO   "glm::max(glm::max(map[0], map[1]), map[2])"
    CASES "instances: a box and a sphere*")

# The sphere knows the mean of the stretches.
ljus_break_it(NAME instances-sphere HEADER math/affine.hpp TEST instances
    FROM "return std::sqrt(mean + T(2) * spread *"
    TO   "return std::sqrt(mean + T(0) * spread *"
    CASES "instances: a box and a sphere*")

# A scene takes an instance of a mesh that may be gone.
ljus_break_it(NAME instances-kept HEADER scene/scene.hpp TEST instances
    FROM "if (std::none_of(kept_.begin(), kept_.end(), is_it))"
    TO   "if (false && std::none_of(kept_.begin(), kept_.end(), is_it))"
    CASES "instances: what cannot*")

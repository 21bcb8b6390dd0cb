# Veach's factor: photons see another scene than camera paths.
ljus_break_it(NAME shading_normals-adjoint HEADER path/continue_path.hpp TEST mesh
    FROM "scattered.sample.weight *= std::abs(factor);"
    TO   ""
    CASES "mesh: photons and camera*")

# The same for where a photon lands.
ljus_break_it(NAME shading_normals-landing HEADER photons/photon_path.hpp TEST mesh
    FROM "return std::abs(vertex.wo.z / glm::dot(direction, vertex.point.normal));"
    TO   "return T(1);"
    CASES "mesh: photons land*")

# What the two normals disagree about shines through the surface.
ljus_break_it(NAME shading_normals-leak HEADER path/continue_path.hpp TEST mesh
    FROM "if (!next->specular) return std::nullopt;"
    TO   "if (!next->specular) return scattered;"
    CASES "mesh: no light leaks*")

# A mirror that would send light into itself sends none: black pixels.
ljus_break_it(NAME shading_normals-black HEADER path/continue_path.hpp TEST mesh
    FROM "if (!again || !again->specular) return std::nullopt;"
    TO   "return std::nullopt;"
    CASES "mesh: mirrors*")

# A surface that its shading normal shows from behind.
ljus_break_it(NAME shading_normals-turned HEADER path/next_vertex.hpp TEST mesh
    FROM "vertex.turned ? geometric : normal"
    TO   "normal"
    CASES "mesh: mirrors*")

# The shading normal alone decides which side a direction is on.
ljus_break_it(NAME shading_normals-side HEADER path/next_vertex.hpp TEST mesh
    FROM "const T side = glm::dot(world, vertex.point.normal);"
    TO   "const T side = T(0) * world.x + local.z;"
    CASES "mesh: no light leaks*")

# A mirror image shows its back.
ljus_break_it(NAME gltf-mirrored HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "if (turned) std::swap(at[1], at[2]);"
    TO   ""
    CASES "load_gltf: nodes place meshes*")

# A normal is moved as a direction of the surface is.
ljus_break_it(NAME gltf-normal HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "mesh_.add_normal(turn *"
    TO   "mesh_.add_normal(m *"
    CASES "load_gltf: normals stay*")

# Every second triangle of a strip shows its back.
ljus_break_it(NAME gltf-strip HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "if (mode == 5) at = {i, i + 1 + i % 2, i + 2 - i % 2};"
    TO   "if (mode == 5) at = {i, i + 1, i + 2};"
    CASES "load_gltf: triangles? strips and fans*")

# The inner place comes after the outer one.
ljus_break_it(NAME gltf-order HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "const glm::dmat4 place = above * matrix_of(node);"
    TO   "const glm::dmat4 place = matrix_of(node) * above;"
    CASES "load_gltf: nodes place meshes*")

# What is below two nodes is left out the second time, without a word.
ljus_break_it(NAME gltf-two-parents HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "if (!seen_.insert(number).second)"
    TO   "if (!seen_.insert(number).second) return; if (false)"
    CASES "load_gltf: a file that cannot be right*")

# Pictures lie upside down.
ljus_break_it(NAME gltf-v HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "mesh_.add_uv(uv[2 * i], 1 - uv[2 * i + 1]);"
    TO   "mesh_.add_uv(uv[2 * i], uv[2 * i + 1]);"
    CASES "load_gltf: accessors that are*")

# Metal is green, and roughness blue.
ljus_break_it(NAME gltf-metal-channel HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "metal *= srgb_encode(double(is.z));"
    TO   "metal *= srgb_encode(double(is.x));"
    CASES "load_gltf: pictures of colour*")

# A light keeps its intensity where distances grow.
ljus_break_it(NAME gltf-light-scale HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "const RgbT<T> intensity(scale * scale * light);"
    TO   "const RgbT<T> intensity(light);"
    CASES "load_gltf: cameras and lights*")

# An accessor may begin within its view and end behind it.
ljus_break_it(NAME gltf-accessor-end HEADER io/detail/gltf_data.hpp TEST load_gltf
    FROM "(bytes.size() - from - element) / stride < count - 1)"
    TO   "false)"
    CASES "load_gltf: a file that cannot be right*")

# Sparse values are not used.
ljus_break_it(NAME gltf-sparse HEADER io/detail/gltf_data.hpp TEST load_gltf
    FROM "result[at[next / size] * size + next % size] = value;"
    TO   "(void)value;"
    CASES "load_gltf: accessors that are*")

# The smallest normalized number is below -1.
ljus_break_it(NAME gltf-normalized HEADER io/detail/gltf_data.hpp TEST load_gltf
    FROM "std::max(value / (range / 2 - 1), -1.0)"
    TO   "value / (range / 2 - 1)"
    CASES "load_gltf: accessors that are*")

# Nodes place as many triangles as a file likes.
ljus_break_it(NAME gltf-triangles HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "if (triangles_ > max_gltf_triangles)"
    TO   "if (false)"
    CASES "load_gltf: one small file*")

# Capital letters make another format.
ljus_break_it(NAME load-mesh-capitals HEADER io/load_mesh.hpp TEST load_gltf
    FROM "return detail::same_word(end, known);"
    TO   "return end == known;"
    CASES "load_mesh: the end of a name*")

# What is no metal is divided by its roughness, and each part has copies of the pictures.
ljus_break_it(NAME gltf-matt-roughness HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "is_metal ? step : -1"
    TO   "step"
    CASES "load_gltf: pictures of colour*")

# Nobody hears of a little transmission.
ljus_break_it(NAME gltf-faint-glass HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "else if (material.dissolve < 1)"
    TO   "else if (false)"
    CASES "load_gltf: what its materials*")

# The colours of a metal's vertices are lost.
ljus_break_it(NAME gltf-metal-colors HEADER io/detail/mesh_builder.hpp TEST load_gltf
    FROM "is.is_mirror() && is.roughness == 0"
    TO   "is.is_mirror()"
    CASES "load_gltf: pictures of colour*")

# What has its colours in the older extension is white metal.
ljus_break_it(NAME gltf-specular-glossiness HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "surface.metal = 0;"
    TO   ""
    CASES "load_gltf: what its materials become")

# The picture of the older extension is looked up by the first texture coordinates.
ljus_break_it(NAME gltf-diffuse-texture HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "field ? color_texture(*surface.material) : std::nullopt;"
    TO   "std::optional<JsonField>{};"
    CASES "load_gltf: pictures of colour*")

# Data within a file have letters that are written as % and their codes.
ljus_break_it(NAME gltf-coded-data HEADER io/detail/gltf_data.hpp TEST load_gltf
    FROM "from_base64(decoded(std::string_view(is).substr(comma + 1)), uri)"
    TO   "from_base64(std::string_view(is).substr(comma + 1), uri)"
    CASES "load_gltf: a mesh is the same*")

# A sun that shines nowhere is loaded.
ljus_break_it(NAME gltf-light-check HEADER io/detail/gltf_reader.hpp TEST load_gltf
    FROM "check(made);"
    TO   ""
    CASES "load_gltf: cameras and lights*")

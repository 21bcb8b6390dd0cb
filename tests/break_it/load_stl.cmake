# What begins with "solid" is text.
ljus_break_it(NAME stl-solid HEADER io/load_stl.hpp TEST load_stl
    FROM [[text.substr(0, stl_head).find('\0') == text.npos]]
    TO   "true"
    CASES "load_stl: a mesh is the same*,load_stl: binary or text*")

# The head is believed.
ljus_break_it(NAME stl-count HEADER io/load_stl.hpp TEST load_stl
    FROM "const std::size_t count = word(80, 4);"
    TO   "const std::size_t count = std::min<std::size_t>(word(80, 4), 3);"
    CASES "load_stl: a mesh is the same*,load_stl: a file that cannot be right*")

# Each triangle has vertices of its own.
ljus_break_it(NAME stl-merge HEADER io/load_stl.hpp TEST load_stl
    FROM "if (number == next) mesh.add_position(corner);
            mesh.add_corner(number,"
    TO   "if (number <= next) mesh.add_position(corner);
            mesh.add_corner(next,"
    CASES "load_stl: a mesh is the same*")

# A triangle that is turned over is not remarked on.
ljus_break_it(NAME stl-turned HEADER io/load_stl.hpp TEST load_stl
    FROM "report.add(MeshTrouble::turned, mesh.place);"
    TO   ";"
    CASES "load_stl: two solids*")

# A file with decimal commas has no numbers.
ljus_break_it(NAME stl-comma HEADER io/detail/parse.hpp TEST load_stl
    FROM "stop != end && *stop == ','"
    TO   "stop != end && *stop == 0"
    CASES "load_stl: two solids*")

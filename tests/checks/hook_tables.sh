#!/usr/bin/env bash
# Checks that the tables of hooks are complete: each function that a requires-expression below
# include/ljus calls is required by the concept of a shape, material or light, is a row of a
# table, or is listed here. So no function of a shape can change behaviour without being
# documented in a table.
# Usage: hook_tables.sh [FOLDER with ljus/ in it]
. "$(dirname "$0")/common.sh"
include=${1:-$include}

# Functions that the concepts require of every shape and every material.
by_concept="as_hit bounding_sphere check intersect surface_point
    evaluate lobes pdf sample"
# Functions required of other types.
of_a_material_of_radiosity=diffuse_albedo
of_a_renderer=radiance
of_a_kernel=kernel_weight
of_a_camera=camera_ray
of_a_texture="color_at turns_normals"
of_a_stream="next_1d next_2d next_3d start_bounce"
# Functions that the concepts require of every light, of near ones and of far ones.
of_a_light="emission_point pdf_emission power sample_arrival sample_emission
    sample_light"
# Functions that the concept requires of every medium.
of_a_medium="bounds extinction phase sample_phase scattering span_in"

# rows FOLDER TABLE: the names in a table of hooks.
rows() {
    sed -n "/\[$2 hooks\]\$/,/\[$2 hooks\]\$/s/.*Hook{\"\([a-z_]*\)\".*/\1/p" \
        "$1/ljus/$3" | sort -u
}

# called FOLDER: "name header" for each function that a requires-expression or a trailing
# return type calls by its unqualified name.
called() {
    find "$1/ljus" -name '*.hpp' -print0 | sort -z | xargs -0 awk '
        function calls(text,    name) {
            while (match(text, /[A-Za-z_][A-Za-z_0-9]*(<[^<>(){}]*>)?[ \n]*\(/)) {
                name = substr(text, RSTART, RLENGTH)
                sub(/[<( \n].*/, "", name)
                if (RSTART == 1 || substr(text, RSTART - 1, 1) !~ /[.:>A-Za-z_0-9]/)
                    if (name !~ /^(requires|decltype|sizeof|noexcept)$/ && name ~ /^[a-z]/)
                        print name, header
                text = substr(text, RSTART + RLENGTH)
            }
        }
        # The position after what opens at i, which is a bracket of the two kinds given.
        function closed(i, open, close_,    depth, c) {
            depth = 0
            for (; i <= length(whole); ++i) {
                c = substr(whole, i, 1)
                if (c == open) ++depth
                if (c == close_ && --depth == 0) return i + 1
            }
            return i
        }
        function blank(i) {
            while (substr(whole, i, 1) ~ /[ \n]/) ++i
            return i
        }
        function look(    at, i, end) {
            at = 1
            while (match(substr(whole, at), /(^|[^A-Za-z_0-9])(requires|decltype)[ \n]*[({]/)) {
                i = at + RSTART + RLENGTH - 2
                at = i
                if (substr(whole, at - 12, 12) ~ /decltype[ \n]*$/) {
                    if (substr(whole, at - 14, 14) ~ /-> *decltype[ \n]*$/)
                        calls(substr(whole, i + 1, closed(i, "(", ")") - i - 2))
                    continue
                }
                if (substr(whole, i, 1) == "(") i = blank(closed(i, "(", ")"))
                if (substr(whole, i, 1) != "{") continue # the condition of a function
                end = closed(i, "{", "}")
                calls(substr(whole, i + 1, end - i - 2))
                at = end
            }
        }
        FNR == 1 {
            if (NR > 1) look()
            whole = ""
            header = FILENAME
            sub(/.*\/ljus\//, "ljus/", header)
        }
        { sub(/\/\/.*/, ""); whole = whole $0 "\n" }
        END { look() }' | sort -u
}

# defaults FOLDER: the functions of shape.hpp for any shape, which a shape may override.
defaults() {
    awk '/^template <Shape /{ near = 4 }
         near-- > 0 && match($0, /[a-z_]+\((const|$)/) {
             name = substr($0, RSTART, RLENGTH); sub(/\(.*/, "", name); print name; near = 0
         }' "$1/ljus/geometry/shape.hpp" | sort -u
}

# holds FOLDER: prints what is missing, and succeeds if nothing is.
holds() {
    local folder=$1 shapes materials lights known name header bad=0
    shapes=$(rows "$folder" shape geometry/shape.hpp)
    materials=$(rows "$folder" material materials/material.hpp)
    lights=$(rows "$folder" light lights/light.hpp)
    [ -n "$shapes" ] && [ -n "$materials" ] && [ -n "$lights" ] || { echo "there is no table"; return 1; }
    # shellcheck disable=SC2086,SC2116 # one word each
    known=" $(echo $by_concept $shapes $materials $lights $of_a_material_of_radiosity \
        $of_a_renderer $of_a_kernel $of_a_camera $of_a_stream $of_a_light $of_a_medium \
        $of_a_texture) "
    while read -r name header; do
        case $known in *" $name "*) continue ;; esac
        echo "$header: $name() is asked for, and is no row of a table of hooks."
        bad=1
    done < <(called "$folder")
    for name in $(defaults "$folder"); do
        grep -qx "$name" <<<"$shapes" && continue
        echo "ljus/geometry/shape.hpp: $name() has a default, and is no row of the table."
        bad=1
    done
    # A row that no code calls has no effect.
    for name in $shapes; do
        grep -rqE "(^|[^a-z_])$name(<[A-Za-z]+>)?\(" "$folder/ljus" \
            --include='*.hpp' --exclude=shape.hpp && continue
        echo "ljus/geometry/shape.hpp: nobody asks for $name()."
        bad=1
    done
    # A constant that is specialised for one type of shape is a hidden hook.
    if grep -rnE 'constexpr bool [a-z_]+<(Sphere|Triangle|Quad|Mesh|Metaballs)(T<|>)' \
        "$folder/ljus"; then
        echo "A property of a shape follows from its functions, see the concept FlatShape."
        bad=1
    fi
    return $bad
}

holds "$include"

# --- The check itself: each of these must be noticed.
wrong=0
sin() {
    local sentence=$1 file=$2 edit=$3
    rm -rf "$scratch/house"
    mkdir "$scratch/house"
    cp -r "$include/ljus" "$scratch/house/ljus"
    sed -i "$edit" "$scratch/house/ljus/$file"
    cmp -s "$include/ljus/$file" "$scratch/house/ljus/$file" &&
        { echo "WRONG: no sin: $edit"; wrong=1; }
    if holds "$scratch/house" >"$scratch/said" || ! grep -qF "$sentence" "$scratch/said"; then
        echo "WRONG: should be noticed: $sentence"
        wrong=1
    fi
}
last='$a\'
sin "secret_hook() is asked for" photons/aiming.hpp \
    "$last template <typename S> concept Secret = requires(const S\& shape) { secret_hook(shape); };"
sin "hidden_hook() is asked for" accel/mesh.hpp \
    "$last template <typename S> auto f(const S\& s) -> decltype(hidden_hook(s)) { return {}; }"
sin "corners_of() is asked for" geometry/shape.hpp '/Hook{"corners_of"/,/requires/d'
sin "center_sample() has a default" geometry/shape.hpp '/Hook{"center_sample"/,/requires/d'
sin "nobody asks for bonds()" geometry/shape.hpp 's/Hook{"bounds"/Hook{"bonds"/'
sin "follows from its functions" geometry/quad.hpp \
    "$last template <typename T> inline constexpr bool is_round<QuadT<T>> = false;"
[ $wrong -eq 0 ] || exit 1
echo "the tables of hooks are complete"

#!/usr/bin/env bash
# Checks one way to use the library, from an empty folder to a running program.
# Usage: consumer.sh plain|find_package|add_subdirectory|pkg_config|fetch|missing|course_project
. "$(dirname "$0")/common.sh"
way=$1
folder=$scratch/consumer_$way
rm -rf "$folder"
mkdir -p "$folder"
source=$LJUS_ROOT/tests/consumer
everything=
[ -f "$include/ljus/ljus.hpp" ] && everything=-DUSES_EVERYTHING

# Hints for the packages that the compiler does not find by itself.
hints() {
    set -- $LJUS_PACKAGE_FLAGS
    while [ $# -ge 2 ]; do
        [ -f "$2/glm/vec3.hpp" ] && echo "-DLJUS_GLM_INCLUDE_DIR=$2"
        [ -f "$2/stb_image_write.h" ] && echo "-DLJUS_STB_INCLUDE_DIR=$2"
        shift 2
    done
    return 0
}
run_cmake() {
    "$LJUS_CMAKE" -G "$LJUS_GENERATOR" -DCMAKE_MAKE_PROGRAM="$LJUS_MAKE_PROGRAM" \
        -DCMAKE_CXX_COMPILER="$LJUS_CXX" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
        -DCMAKE_CXX_FLAGS="$everything" "$@"
}
build_and_run() {
    run_cmake -S "$source" -B "$folder/build" "$@" >"$folder/configure.log" 2>&1 ||
        { cat "$folder/configure.log"; exit 1; }
    "$LJUS_CMAKE" --build "$folder/build"
    "$folder/build/consumer" | tee "$folder/output"
    grep -q "^Ljus $LJUS_VERSION: 0$" "$folder/output"
}
install_ljus() {
    run_cmake -S "$LJUS_ROOT" -B "$folder/ljus" -DCMAKE_INSTALL_PREFIX="$folder/first" \
        -DLJUS_TESTS=OFF -DLJUS_EXAMPLES=OFF -DLJUS_FETCH=OFF $(hints) "$@" >"$folder/ljus.log" 2>&1 ||
        { cat "$folder/ljus.log"; exit 1; }
    "$LJUS_CMAKE" --build "$folder/ljus" --target install >>"$folder/ljus.log"
    # Move it, because a package may be unpacked anywhere.
    mv "$folder/first" "$folder/prefix"
    for file in include/ljus/version.hpp share/cmake/ljus/ljus-config.cmake \
        share/pkgconfig/ljus.pc; do
        [ -f "$folder/prefix/$file" ] || { echo "$file was not installed."; exit 1; }
    done
    if grep -rn "$LJUS_ROOT\|$folder" "$folder/prefix/share"; then
        echo "The installed package names a folder of this machine."
        exit 1
    fi
}

case $way in
    plain)
        # shellcheck disable=SC2086
        "$LJUS_CXX" -std=c++20 -O2 $everything $LJUS_OPENMP_FLAGS $LJUS_PACKAGE_FLAGS \
            -I"$include" "$source/main.cpp" -o "$folder/consumer"
        "$folder/consumer"
        ;;
    find_package)
        install_ljus
        build_and_run -DCMAKE_PREFIX_PATH="$folder/prefix" $(hints)
        rm -rf "$folder/build"
        echo "and with the compiled engines:"
        build_and_run -DCMAKE_PREFIX_PATH="$folder/prefix" $(hints) -DLJUS_CONSUMER_CORE=ON
        rm -rf "$folder/build"
        echo "and without OpenMP:"
        build_and_run -DCMAKE_PREFIX_PATH="$folder/prefix" $(hints) -DLJUS_OPENMP=OFF
        rm -rf "$folder/build"
        if run_cmake -S "$source" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" \
            -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON -DCMAKE_IGNORE_PATH="/usr/include" \
            >"$folder/configure.log" 2>&1; then
            echo "note: GLM was found all the same; the sentence about it is not tested"
        else
            tr -s " \n" "  " <"$folder/configure.log" | grep -F "Ljus needs GLM" >/dev/null
        fi
        ;;
    add_subdirectory)
        build_and_run -DLJUS_FOLDER="$LJUS_ROOT" $(hints)
        ;;
    pkg_config)
        command -v pkg-config >/dev/null || skip "pkg-config is not installed"
        install_ljus -DLJUS_INSTALL_CORE=OFF
        export PKG_CONFIG_PATH=$folder/prefix/share/pkgconfig
        [ "$(pkg-config --modversion ljus)" = "$LJUS_VERSION" ]
        # shellcheck disable=SC2046,SC2086
        "$LJUS_CXX" -std=c++20 $(pkg-config --cflags ljus) $LJUS_PACKAGE_FLAGS \
            "$source/main.cpp" -o "$folder/consumer"
        "$folder/consumer"
        ;;
    fetch)
        # GLM and stb come from local repositories in place of the upstream ones.
        command -v git >/dev/null || skip "git is not installed"
        repository() {
            git init -q "$folder/$1"
            mkdir -p "$folder/$1/$(dirname "$3")"
            cp -R "$2" "$folder/$1/$3"
            git -C "$folder/$1" add -A
            git -C "$folder/$1" -c user.name=test -c user.email=test@localhost \
                -c commit.gpgsign=false commit -q -m "A stand-in"
            git -C "$folder/$1" rev-parse HEAD
        }
        depends() {
            # shellcheck disable=SC2086
            echo "#include <$1>" | "$LJUS_CXX" $LJUS_PACKAGE_FLAGS -M -x c++ - 2>/dev/null |
                tr ' \\' '\n\n' | awk -v end="$1" \
                'substr($0, length($0) - length(end)) == "/" end && !seen++' |
                grep .
        }
        glm=$(depends glm/vec3.hpp)
        stb=$(depends stb/stb_image_write.h || depends stb_image_write.h) || skip "no stb"
        glm_commit=$(repository glm "$(dirname "$glm")" glm)
        stb_commit=$(repository stb "$stb" stb_image_write.h)
        locally="-DLJUS_FETCH=ALWAYS
            -DLJUS_GLM_REPOSITORY=file://$folder/glm -DLJUS_STB_REPOSITORY=file://$folder/stb
            -DLJUS_STB_COMMIT=$stb_commit"
        # shellcheck disable=SC2086
        build_and_run -DLJUS_FOLDER="$LJUS_ROOT" $locally -DLJUS_GLM_COMMIT="$glm_commit"
        [ -f "$folder/build/_deps/ljus-glm-src/glm/vec3.hpp" ] ||
            { echo "GLM was not fetched into the build folder."; exit 1; }
        rm -rf "$folder/build"
        # A commit that is not there is an error, not another version.
        # shellcheck disable=SC2086
        if run_cmake -S "$source" -B "$folder/build" -DLJUS_FOLDER="$LJUS_ROOT" $locally \
            -DLJUS_GLM_COMMIT=0123456789012345678901234567890123456789 \
            >"$folder/configure.log" 2>&1; then
            echo "A commit that does not exist was accepted."
            exit 1
        fi
        echo "fetched by commit into the build folder; a wrong commit is refused"
        ;;
    missing)
        # A package that is optional is missing: the rest of the project is configured.
        run_cmake -S "$LJUS_ROOT" -B "$folder/least" -DLJUS_FETCH=OFF $(hints) \
            -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenEXR=ON \
            -DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON -DCMAKE_DISABLE_FIND_PACKAGE_Python3=ON \
            >"$folder/configure.log" 2>&1 ||
            grep -q "Ljus: .* is not installed; install" "$folder/configure.log" ||
            { cat "$folder/configure.log"; exit 1; }
        # Nothing is installed and nothing may be fetched: one sentence says what to do.
        if run_cmake -S "$LJUS_ROOT" -B "$folder/build" -DLJUS_FETCH=OFF \
            -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON -DCMAKE_IGNORE_PATH="/usr/include" \
            >"$folder/configure.log" 2>&1; then
            skip "GLM is found all the same"
        fi
        tr -s ' \n' '  ' <"$folder/configure.log" | grep -oF \
            "Ljus: glm is not installed; install it (sudo apt-get install libglm-dev)" ||
            { cat "$folder/configure.log"; exit 1; }
        ;;
    course_project)
        # examples/course_project, copied to an empty folder, in each of its ways.
        install_ljus -DLJUS_INSTALL_CORE=OFF
        source=$folder/project
        one_way() {
            rm -rf "$folder/project" "$folder/build"
            cp -R "$LJUS_ROOT/examples/course_project" "$folder/project"
            [ "$1" != single ] || cp "$folder/prefix/share/ljus/single/ljus.hpp" "$source/"
            echo "by $1:"
            shift
            run_cmake -S "$source" -B "$folder/build" "$@" >"$folder/configure.log" 2>&1 ||
                { cat "$folder/configure.log"; exit 1; }
            "$LJUS_CMAKE" --build "$folder/build"
            (cd "$folder" && build/course_project)
            [ -f "$folder/first.png" ] || cp "$folder/picture.png" "$folder/first.png"
            cmp "$folder/picture.png" "$folder/first.png"
            rm "$folder/picture.png"
        }
        # shellcheck disable=SC2046
        one_way "an installed Ljus" -DCMAKE_PREFIX_PATH="$folder/prefix" $(hints)
        # shellcheck disable=SC2046
        one_way "a folder" -DLJUS_FROM="$LJUS_ROOT" $(hints)
        if commit=$(git -C "$LJUS_ROOT" rev-parse HEAD 2>/dev/null); then
            # shellcheck disable=SC2046
            one_way "a repository" -DLJUS_FROM="file://$LJUS_ROOT" \
                -DLJUS_COMMIT="$commit" $(hints)
        fi
        if [ -f "$folder/prefix/share/ljus/single/ljus.hpp" ]; then
            one_way single -DCMAKE_CXX_FLAGS="$LJUS_PACKAGE_FLAGS"
        else
            echo "no single header was installed, because Python is not"
        fi
        ;;
    *) echo "consumer.sh: there is no way '$way'." >&2; exit 2 ;;
esac
rm -rf "$folder"

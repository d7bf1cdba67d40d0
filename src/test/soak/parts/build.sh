# The job jars and the classes of soaks, built where needed. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home, logs come from the soak

# build_soaks MODULES: comma-separated, those that the soak runs.
build_soaks() {
    local built=$home/suite/launcher/target/soak-built
    [[ -f $built && -z $(find "$home/pom.xml" "$home"/{*,*/*}/pom.xml "$home"/{src,*/src,*/*/src} -newer "$built" -print -quit) ]] && return
    say "building"
    (cd "$home" && ./mvnw -B -ntp package -DskipTests -Dspotless.check.skip -pl ingest,analytics,"$1" -am) \
        >"$logs/build.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed."; }
    touch "$built" "$home/suite/launcher/target/furrow/built"
}

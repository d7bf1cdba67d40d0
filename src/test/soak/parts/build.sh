# Builds the job jars and the classes of the soaks if sources have changed. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home, logs come from the soak

build_soaks() {
    local built=$home/suite/launcher/target/soak-built
    [[ -f $built && -z $(find "$home/pom.xml" "$home"/{*,*/*}/pom.xml "$home"/{src,*/src,*/*/src} -newer "$built" -print -quit) ]] && return
    say "building"
    (cd "$home" && ./mvnw -B -ntp package -DskipTests -Dspotless.check.skip -pl src -am) \
        >"$logs/build.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed."; }
    touch "$built" "$home/suite/launcher/target/furrow/built"
}

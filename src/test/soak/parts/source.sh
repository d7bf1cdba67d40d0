# Builds and runs soaks that are Java programs. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home and java come from the soak

# Prepares, and builds.
prepare_source() {
    prepare
    build_source
}

# Saves the logs of the processes that the programs have started.
save_logs() {
    local log name
    for log in "$run"/*.{log,out} "$run"/*/worker.{log,out} "$run"/*/*/worker.{log,out}; do
        name=${log#"$run/"}
        [[ ! -f $log ]] || cp "$log" "$logs/${name//\//-}"
    done
}

build_source() {
    local built=$home/suite/launcher/target/source-soak-built
    [[ -f $built && -z $(find "$home/pom.xml" "$home"/{*,*/*}/pom.xml "$home"/{src,*/src,*/*/src} -newer "$built" -print -quit) ]] && return
    say "building"
    (cd "$home" && ./mvnw -B -ntp package -DskipTests -Dshade.skip=true -Dspotless.check.skip -pl src -am) \
        >"$logs/build.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed."; }
    touch "$built" "$home/suite/launcher/target/furrow/built"
}

# browser_path: writes the class path of the system tests to $run/path.
# The suite's lib does not have Playwright's driver. The system tests are built last, so the file has their class path.
browser_path() {
    (cd "$home" && ./mvnw -B -q -ntp -pl src -am package dependency:build-classpath -Dmaven.test.skip.exec -Dshade.skip=true \
        -Dspotless.check.skip -Dmdep.includeScope=test -Dmdep.outputFile="$run/path") \
        >"$logs/path.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/path.log" | head -n 5 >&2; fail "Cannot compute the class path: $logs/path.log"; }
}

# run_program CLASS ARGUMENTS…: runs a program below io.furrow.soak, and prefixes its output with the time.
run_program() {
    local name=${1##*.} suite=$home/suite/launcher/target/furrow browser=
    [[ ! -f $run/path ]] || browser=:$(<"$run/path")
    "$java" -Xmx768m -Dfurrow.log="$logs/$name.log" -Dfurrow.plugins="$suite/plugins" \
        -cp "$home/src/target/test-classes:$suite/lib/*$browser:$suite/lib-last/*" "io.furrow.soak.$1" "${@:2}" \
        > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/$name.out" &
    own $!
    wait $!
}

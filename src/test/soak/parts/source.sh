# The soaks of the NGSI source: a build, a folder, and a Java program that does the rest. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home and java come from the soak

# prepare_source NAME: sets run and logs, builds, and cleans up at the end.
prepare_source() {
    soak_name=$1
    run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-$soak_name.XXXXXX")
    logs=$home/target/soak/$soak_name
    trap clean_up EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM
    rm -rf "$logs"
    mkdir -p "$logs"
    build_source
}

clean_up() {
    local code=$?
    trap - EXIT INT TERM
    stop_own
    local log name
    for log in "$run"/*/worker.{log,out} "$run"/*/*/worker.{log,out}; do
        name=${log#"$run/"}
        [[ -f $log ]] && cp "$log" "$logs/${name//\//-}"
    done
    rm -rf "$run"
    case $code in
        0) ;;
        130 | 143) echo "$soak_name: interrupted" ;;
        *) printf '%s: failed; logs: %s\n' "$soak_name" "$logs" ;;
    esac
    exit "$code"
}

build_source() {
    local built=$home/suite/launcher/target/source-soak-built
    [[ -f $built && -z $(find "$home/pom.xml" "$home"/{*,*/*}/pom.xml "$home"/{src,*/src,*/*/src} -newer "$built" -print -quit) ]] && return
    say "building the connector"
    (cd "$home" && ./mvnw -B -ntp package -DskipTests -Dshade.skip=true -Dspotless.check.skip -pl src -am) \
        >"$logs/build.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed."; }
    touch "$built" "$home/suite/launcher/target/furrow/built"
}

# browser_path: writes the class path of the system tests to $run/path.
# Playwright's driver is for tests only: it is not in the suite's lib. The system tests come last, their path is the one that stays.
browser_path() {
    (cd "$home" && ./mvnw -B -q -ntp -pl src -am package dependency:build-classpath -Dmaven.test.skip.exec -Dshade.skip=true \
        -Dspotless.check.skip -Dmdep.includeScope=test -Dmdep.outputFile="$run/path") \
        >"$logs/path.log" 2>&1 || { grep -E '^\[ERROR\]' "$logs/path.log" | head -n 5 >&2; fail "The class path could not be made: $logs/path.log"; }
}

# run_source CLASS ARGUMENTS…: its lines are shown with the seconds.
run_source() {
    local class=$1 suite=$home/suite/launcher/target
    shift
    "$java" -Xmx768m -Dfurrow.log="$logs/$class.log" -Dfurrow.plugins="$suite/furrow/plugins" \
        -cp "$home/src/target/test-classes:$suite/furrow/lib/*" "io.furrow.soak.source.$class" "$@" \
        > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/$class.out" &
    own $!
    wait $!
}

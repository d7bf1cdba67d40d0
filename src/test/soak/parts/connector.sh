# Builds the classes of the NGSI connector and its tests. Sourced after machine.sh, not run.
# shellcheck shell=bash

# Sets connector_classes to their class path.
build_connector() {
    local jars=$home/target/soak/connector-jars
    say "building the connector"
    (cd "$home" && ./mvnw -B -ntp package dependency:copy-dependencies -DskipTests -Dspotless.check.skip -pl ngsi-connector -am \
        -DincludeScope=test -DoutputDirectory="$jars") >"$logs/build.log" 2>&1 ||
        { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed: $logs/build.log"; }
    connector_classes=$home/ngsi-connector/target/test-classes:$home/ngsi-connector/target/classes:$jars/*
}

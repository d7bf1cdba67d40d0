#!/usr/bin/env bash
# Fuzzes the parsers of notifications, journals, their records and responses of a context broker with Jazzer, at 512 MB of heap.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/connector.sh
. "$soak/parts/connector.sh"

jazzer_version=0.30.0
seconds=600
targets=(bodies journal records pages answers gzip)
target=

usage() {
    cat <<USAGE
Usage: ./furrow soak fuzz [OPTION VALUE]…
Runs Jazzer $jazzer_version on one target after the other. Passes unless an input crashes, hangs for 10 s or runs out of 512 MB. Add such an
input to ngsi-connector/src/test/resources/fuzz, which every build tests.

  --seconds N    Duration of each target, at least 10. Default: $seconds.
  --target NAME  One of bodies, journal, records, pages, answers or gzip.
USAGE
}

read_options "seconds target" "$@"
check_numbers 10 seconds
[[ -z $target ]] || { check_choice target "${targets[@]}" && targets=("$target"); }

prepare

build_connector
for artifact in jazzer jazzer-api; do
    (cd "$home" && ./mvnw -B -ntp -q -N dependency:copy -Dartifact="com.code-intelligence:$artifact:$jazzer_version" \
        -DoutputDirectory="$home/target/soak/jazzer") >>"$logs/build.log" 2>&1 || fail "Cannot fetch Jazzer: $logs/build.log"
done

class_of() {
    case $1 in
        bodies) echo io.furrow.connect.source.FuzzBodies ;;
        journal) echo io.furrow.connect.journal.FuzzJournal ;;
        records) echo io.furrow.connect.source.journal.FuzzRecords ;;
        pages) echo io.furrow.connect.repair.FuzzPages ;;
        answers) echo io.furrow.connect.sink.api.FuzzAnswers ;;
        gzip) echo io.furrow.connect.source.http.FuzzGzip ;;
    esac
}

failed=0
corpora=$home/ngsi-connector/src/test/resources/fuzz
for target in "${targets[@]}"; do
    mkdir -p "$run/$target" "$logs/$target"
    [[ ! -d $corpora/$target ]] || cp "$corpora/$target"/* "$run/$target"
    options=(-max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=1500 -print_final_stats=1)
    [[ ! -f $corpora/$target.dict ]] || options+=(-dict="$corpora/$target.dict")
    say "fuzzing $target for $seconds s"
    (cd "$logs/$target" && exec "$java" -Xmx512m -Djava.io.tmpdir="$run" -cp "$connector_classes:$home/target/soak/jazzer/*" \
        com.code_intelligence.jazzer.Jazzer --target_class="$(class_of "$target")" \
        --instrumentation_includes='io.furrow.**:com.fasterxml.jackson.core.**' --custom_hook_includes='io.furrow.**' \
        "${options[@]}" "$run/$target") >"$logs/$target.log" 2>&1 &
    own $!
    if wait $!; then
        say "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$logs/$target.log") inputs, no failure"
    else
        failed=1
        say "$target: failure found: $logs/$target.log, $(ls "$logs/$target" | tr '\n' ' ')"
    fi
done
((failed == 0)) || exit 1
echo "fuzz: passed"

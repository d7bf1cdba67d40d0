#!/usr/bin/env bash
# Fuzzes the reading of notifications, journals, their records and a context broker's answers with Jazzer, at 512 MB of heap.
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

usage() {
    cat <<USAGE
Usage: ./furrow soak fuzz [OPTION VALUE]…
Runs Jazzer $jazzer_version, one target after the other. It passes where none finds an input that crashes, hangs for 10 s or runs
out of 512 MB. What it finds belongs into ngsi-connector/src/test/resources/fuzz, where every build tries it again.

  --seconds N    For each target, at least 10. Default: $seconds.
  --target NAME  Only bodies, journal, records, pages, answers or gzip.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        --target) targets=("${2-}") ;;
        *) fail "fuzz knows no option $1. See: ./furrow soak fuzz --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak fuzz --help"
    shift 2
done
[[ $seconds =~ ^[0-9]+$ && $seconds -ge 10 ]] || fail "--seconds must be a whole number from 10, not '$seconds'."
[[ ${targets[0]} =~ ^(bodies|journal|records|pages|answers|gzip)$ ]] || fail "--target must be bodies, journal, records, pages, answers or gzip, not '${targets[0]}'."

run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-fuzz.XXXXXX")
logs=$home/target/soak/fuzz
trap 'stop_own; rm -rf "$run"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$logs"
mkdir -p "$logs"

build_connector
for artifact in jazzer jazzer-api; do
    (cd "$home" && ./mvnw -B -ntp -q -N dependency:copy -Dartifact="com.code-intelligence:$artifact:$jazzer_version" \
        -DoutputDirectory="$home/target/soak/jazzer") >>"$logs/build.log" 2>&1 || fail "Jazzer could not be fetched: $logs/build.log"
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

found=0
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
        say "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$logs/$target.log") inputs, nothing found"
    else
        found=1
        say "$target: found something: $logs/$target.log, $(ls "$logs/$target" | tr '\n' ' ')"
    fi
done
((found == 0)) || { echo "fuzz: failed"; exit 1; }
echo "fuzz: passed"

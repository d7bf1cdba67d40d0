#!/usr/bin/env bash
# Runs the job jars on a standalone Flink cluster, stops them with a savepoint and goes on from it.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/kafka.sh
. "$soak/parts/kafka.sh"
# shellcheck source=parts/build.sh
. "$soak/parts/build.sh"
# shellcheck source=parts/flink.sh
. "$soak/parts/flink.sh"

seconds=120
parallelism=1
restore_parallelism=
delivery=at-least-once
window=5

usage() {
    cat <<USAGE
Usage: ./furrow soak flink-run [OPTION VALUE]…
Runs every job with flink run on a standalone Flink $flink_version beside a Kafka broker, both started for this: ingest, normalize,
presence, temperature twice (blue and green) and collision twice (two thresholds). While numbered events come in, stops all
with a savepoint and goes on from it. Then everything that the jobs wrote must be there once, and green must be as blue. FLINK_HOME names a distribution; without it one is fetched once, some 315 MB.

  --seconds N              How long events come in, at least 90 s. Default: $seconds.
  --parallelism N          Subtasks before the savepoint, 1 or 2. Default: $parallelism.
  --restore-parallelism N  Subtasks after it, 1 or 2. Default: as before.
  --delivery MODE          at-least-once or exactly-once. Default: $delivery.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        --parallelism) parallelism=${2-} ;;
        --restore-parallelism) restore_parallelism=${2-} ;;
        --delivery) delivery=${2-} ;;
        *) fail "flink-run knows no option $1. See: ./furrow soak flink-run --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak flink-run --help"
    shift 2
done
restore_parallelism=${restore_parallelism:-$parallelism}
[[ $seconds =~ ^[0-9]+$ && $seconds -ge 90 ]] || fail "--seconds must be a whole number from 90, not '$seconds'."
[[ $parallelism =~ ^[12]$ && $restore_parallelism =~ ^[12]$ ]] || fail "The parallelism must be 1 or 2: the cluster has 14 slots for seven jobs."
[[ $delivery == at-least-once || $delivery == exactly-once ]] || fail "--delivery must be at-least-once or exactly-once, not '$delivery'."
command -v curl >/dev/null || fail "No curl found, which asks Flink whether it is ready. Install curl."

run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-flink-run.XXXXXX")
logs=$home/target/soak/flink-run
classes=$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*
# An instance is a job, or a job and what its name adds.
instances=(ingest normalize presence temperature temperature-green collision collision-wide)
ids=()
savepoints=()

clean_up() {
    local code=$?
    trap - EXIT INT TERM
    stop_own
    rm -rf "$run" "${making:-}"
    case $code in
        0) ;;
        130 | 143) echo "flink-run: interrupted" ;;
        *) printf 'flink-run: failed; logs: %s\n' "$logs" ;;
    esac
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$logs"
mkdir -p "$logs"

jar_of() {
    local module=analytics
    [[ $1 == ingest || $1 == normalize ]] && module=ingest
    ls "$home/$module/target/furrow-$module"-*-job.jar
}

# Each job explains itself where Flink is not.
check_help() {
    for name in ingest normalize presence temperature collision; do
        "$java" -jar "$(jar_of "$name")" "$name" --help >"$logs/$name.help" 2>&1 || fail "$name --help fails: $logs/$name.help"
        grep -q -- '--bootstrap-servers' "$logs/$name.help" || fail "$name --help shows no options: $logs/$name.help"
    done
}

# A wrong option is answered with a sentence.
check_refusals() {
    for name in ingest normalize presence temperature collision; do
        ! "$FLINK_HOME/bin/flink" run -d "$(jar_of "$name")" "$name" --no-such-option >"$logs/$name.refusal" 2>&1 ||
            fail "flink run of $name with a wrong option ends with 0."
        grep -q "Unknown option: '--no-such-option'" "$logs/$name.refusal" && grep -q "^See: .* $name --help" "$logs/$name.refusal" &&
            ! grep -q $'^\tat ' "$logs/$name.refusal" || fail "flink run of $name with a wrong option: $logs/$name.refusal"
        ! "$java" -jar "$(jar_of "$name")" "$name" --no-such-option >"$logs/$name.refusal" 2>&1 && ! grep -q $'^\tat ' "$logs/$name.refusal" ||
            fail "$name with a wrong option, without Flink: $logs/$name.refusal"
    done
}

# run_job INSTANCE PARALLELISM FLINK-OPTIONS…: appends its id to ids.
run_job() {
    local instance=$1 name=${1%%-*} subtasks=$2 own_options=(--name "$1")
    shift 2
    case $name in
        normalize) own_options+=(--input orion.native --output data.raw.native) ;;
        temperature) own_options+=(--fields "$soak/fields.geojson" --window "${window}s") ;;
        presence) own_options+=(--fields "$soak/fields.geojson") ;;
    esac
    case $instance in
        temperature-green) own_options+=(--output data.temperature.green --late-output data.temperature.green.late) ;;
        collision-wide) own_options+=(--threshold 8 --output data.collision.wide --late-output data.collision.wide.late --overflow-output data.collision.wide.overflow) ;;
    esac
    "$FLINK_HOME/bin/flink" run -d "$@" "$(jar_of "$name")" "$name" --bootstrap-servers "$bootstrap" --checkpoint-interval 5s \
        --delivery "$delivery" --parallelism "$subtasks" "${own_options[@]}" >"$logs/run-$instance.out" 2>&1 ||
        { tail -n 5 "$logs/run-$instance.out" >&2; fail "flink run of $instance failed."; }
    ids+=("$(sed -n 's/.*submitted with JobID \([0-9a-f]*\).*/\1/p' "$logs/run-$instance.out")")
    say "flink run $* $instance: ${ids[${#ids[@]} - 1]}"
}

# stop_job INSTANCE ID: appends its savepoint to savepoints.
stop_job() {
    "$FLINK_HOME/bin/flink" stop --savepointPath "file://$run/savepoints" "$2" >"$logs/stop-$1.out" 2>&1 ||
        { tail -n 5 "$logs/stop-$1.out" >&2; fail "flink stop of $1 failed."; }
    savepoints+=("$(sed -n 's/.*Savepoint completed. Path: //p' "$logs/stop-$1.out")")
    say "flink stop $1: ${savepoints[${#savepoints[@]} - 1]##*/}"
}

show_jobs() { "$java" -Dfurrow.log="$logs/client.log" -cp "$classes" io.furrow.soak.ClusterJobs "$rest" "${ids[@]}"; }
writing() { grep -q '^writing' "$logs/events.out"; }

build_soaks system-tests
check_help
say "--help of all jobs works without Flink"
provide_flink
check_refusals
say "a wrong option is refused with a sentence by all jobs"
start_kafka
say "Kafka at $bootstrap"
task_slots=14 task_manager_memory=3072m start_flink
say "Flink at $rest, from $FLINK_HOME"

"$java" -Xmx128m -Dfurrow.log="$logs/client.log" -cp "$classes" io.furrow.soak.NumberedEvents "$bootstrap" "$seconds" \
    >"$logs/events.out" 2>&1 &
events=$!
own "$events"
began=$SECONDS
until_true 30 "The topic data.raw" writing
say "events come in for $seconds s"
for instance in "${instances[@]}"; do run_job "$instance" "$parallelism"; done

# Late enough for results, early enough for as long a time after it.
while ((SECONDS < began + seconds * 2 / 5)); do sleep 0.5; done
show_jobs || fail "The cluster does not show the jobs as they should be."
for i in "${!instances[@]}"; do stop_job "${instances[i]}" "${ids[i]}"; done
sleep 4
ids=()
for i in "${!instances[@]}"; do run_job "${instances[i]}" "$restore_parallelism" -s "${savepoints[i]}"; done

wait "$events" || { cat "$logs/events.out" >&2; fail "The events could not be written."; }
say "$(tail -n 1 "$logs/events.out")"
"$java" -Xmx256m -Dfurrow.log="$logs/client.log" -cp "$classes" io.furrow.soak.NumberedResults "$bootstrap" $((window * 1000)) ||
    fail "What the jobs wrote differs from what the events come to."
show_jobs >"$logs/jobs-after.out" || { cat "$logs/jobs-after.out"; fail "The jobs did not go on undisturbed."; }
say "the jobs run on, none failed"
echo "flink-run: passed"

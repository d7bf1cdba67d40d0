#!/usr/bin/env bash
# Runs the job jars on a standalone Flink cluster, stops them with a savepoint and restores them from it.
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
Starts a Kafka broker and a standalone Flink $flink_version, and runs every job with flink run: ingest, normalize, presence,
temperature twice (blue and green) and collision twice (two thresholds). While numbered events are written, stops all jobs with a
savepoint and restores them from it. Each result must then be there once, and green must equal blue. Uses the Flink of FLINK_HOME,
or fetches one once (some 315 MB).

  --seconds N              Duration of the events, at least 90 s. Default: $seconds.
  --parallelism N          Subtasks before the savepoint, 1 or 2. Default: $parallelism.
  --restore-parallelism N  Subtasks after the savepoint, 1 or 2. Default: the same.
  --delivery MODE          at-least-once or exactly-once. Default: $delivery.
USAGE
}

read_options "seconds parallelism restore-parallelism delivery" "$@"
restore_parallelism=${restore_parallelism:-$parallelism}
check_numbers 90 seconds
[[ $parallelism =~ ^[12]$ && $restore_parallelism =~ ^[12]$ ]] || fail "The parallelism must be 1 or 2: the cluster has 14 slots for seven jobs."
check_choice delivery at-least-once exactly-once
command -v curl >/dev/null || fail "curl is missing, which probes Flink. Install curl."

prepare
classes=$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*
# An instance is named after its job, with a suffix for a second one.
instances=(ingest normalize presence temperature temperature-green collision collision-wide)
ids=()
savepoints=()

jar_of() {
    local module=analytics
    [[ $1 == ingest || $1 == normalize ]] && module=ingest
    ls "$home/$module/target/furrow-$module"-*-job.jar
}

# Each job has a --help that works without Flink.
check_help() {
    for name in ingest normalize presence temperature collision coverage; do
        "$java" -jar "$(jar_of "$name")" "$name" --help >"$logs/$name.help" 2>&1 || fail "$name --help fails: $logs/$name.help"
        grep -q -- '--bootstrap-servers' "$logs/$name.help" || fail "$name --help shows no options: $logs/$name.help"
    done
}

# An unknown option is reported without a stack trace.
check_unknown_option() {
    for name in ingest normalize presence temperature collision coverage; do
        ! "$FLINK_HOME/bin/flink" run -d "$(jar_of "$name")" "$name" --no-such-option >"$logs/$name.error" 2>&1 ||
            fail "flink run of $name with an unknown option ends with 0."
        grep -q "Unknown option: '--no-such-option'" "$logs/$name.error" && grep -q "^See: .* $name --help" "$logs/$name.error" &&
            ! grep -q $'^\tat ' "$logs/$name.error" || fail "flink run of $name with an unknown option: $logs/$name.error"
        ! "$java" -jar "$(jar_of "$name")" "$name" --no-such-option >"$logs/$name.error" 2>&1 && ! grep -q $'^\tat ' "$logs/$name.error" ||
            fail "$name with an unknown option, without Flink: $logs/$name.error"
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

build_soaks
check_help
say "--help of all jobs works without Flink"
provide_flink
check_unknown_option
say "all jobs report an unknown option without a stack trace"
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
say "events are written for $seconds s"
for instance in "${instances[@]}"; do run_job "$instance" "$parallelism"; done

# Late enough for results before the savepoint, early enough for results after it.
while ((SECONDS < began + seconds * 2 / 5)); do sleep 0.5; done
show_jobs || fail "The jobs on the cluster are not as expected."
for i in "${!instances[@]}"; do stop_job "${instances[i]}" "${ids[i]}"; done
sleep 4
ids=()
for i in "${!instances[@]}"; do run_job "${instances[i]}" "$restore_parallelism" -s "${savepoints[i]}"; done

wait "$events" || { cat "$logs/events.out" >&2; fail "Cannot write the events."; }
say "$(tail -n 1 "$logs/events.out")"
"$java" -Xmx256m -Dfurrow.log="$logs/client.log" -cp "$classes" io.furrow.soak.NumberedResults "$bootstrap" $((window * 1000)) ||
    fail "The results of the jobs differ from the expected results."
show_jobs >"$logs/jobs-after.out" || { cat "$logs/jobs-after.out"; fail "The jobs did not run on without a failure."; }
say "all jobs run, none failed"
echo "flink-run: passed"
